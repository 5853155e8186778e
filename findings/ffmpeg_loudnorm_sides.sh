#!/usr/bin/env bash
# FFmpeg's filter loudnorm does not hear the side loudspeakers of 7.1: it measures -inf where its filter ebur128 measures
# -16.6 LUFS. Sound behind the listener is measured by both.
. "$(dirname "$0")/packages.sh"
need ffmpeg=7:5.1.9-0+deb12u1
tone() { ffmpeg -hide_banner -nostats -f lavfi -i "sine=f=1000:d=5" -af "pan=7.1|$1,$2" -f null - 2>&1; }
for place in SL=c0'|'SR=c0 BL=c0'|'BR=c0; do
  by_loudnorm=$(tone "$place" loudnorm=print_format=json | sed -n 's/.*"input_i" : "\(.*\)",/\1/p')
  by_ebur128=$(tone "$place" ebur128 | sed -n 's/^ *I: *\(.*\) LUFS/\1/p' | tail -n 1)
  echo "${place//=c0/}: loudnorm $by_loudnorm, ebur128 $by_ebur128" | tee -a levels.txt
done
expect "loudnorm does not hear the sides" grep -q "^SL|SR: loudnorm -inf, ebur128 -16.6" levels.txt
expect "it hears what is behind" grep -q "^BL|BR: loudnorm -16.5[0-9], ebur128 -16.6" levels.txt
