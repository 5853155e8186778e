# Sourced by each finding. `need NAME=VERSION...` puts pinned Debian 12 packages, with all that they depend on, into the
# temporary folder $root, where programs and libraries are then found first. Status 77 if a package cannot be had.
set -euo pipefail
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
cd "$root"

need() {
  mkdir -p cache/archives/partial installed work
  : > status
  # An empty list of installed packages: what they depend on is fetched, too.
  apt-get -qq -y -o Dir::State::status="$root/status" -o Dir::Cache="$root/cache" -o Debug::NoLocking=true \
    --no-install-recommends --download-only install "$@" > apt.log 2>&1 ||
    { echo "cannot be had: $*"; tail -n 3 apt.log; exit 77; }
  local package
  for package in cache/archives/*.deb; do
    case $(basename "$package") in libc6_* | libc-bin_* | libgcc-s1_* | libstdc++6_*) ;;  # the system's own
    *) dpkg -x "$package" installed ;;
    esac
  done
  export PATH="$root/installed/usr/bin:$PATH" XDG_DATA_DIRS="$root/installed/usr/share"
  LD_LIBRARY_PATH=$(find "$root/installed" -name '*.so*' -printf '%h\n' | sort -u | paste -sd:)
  export LD_LIBRARY_PATH
  cd work
  echo "$*"
}

# `expect WHAT COMMAND...`: the behaviour that this finding is about; status 1 where it has changed.
expect() {
  if "${@:2}"; then echo "as found: $1"; else echo "CHANGED: no longer so: $1"; exit 1; fi
}
