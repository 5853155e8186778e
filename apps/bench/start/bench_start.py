#!/usr/bin/python3
"""The bench of the start: how long a user waits for the first picture, and what memory it takes, beside f3d.

    script/bench start [--quick] [--json FILE] [--list]

Both programs open the glTF file of the paper's city, from the same camera of it, and write a picture of 1280 x 720, of which
the bench sees after each run that it is there and shows something. Memory is what all processes of a program have at one moment (of
f3d's those of the virtual display left out), pages that they share counted once, read every 20 ms, in runs that are not timed.
"""

import pathlib
import statistics
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from files.judge_reports import pixels
from outside import PARVIS, ROOT, Skipped, main

FOLDER = ROOT / "build/bench_start"
SIZE, LARGE = "1280x720", "5120x2880"  # of the controls of memory
DISPLAY = ["xvfb-run", "-a", "-s", "-screen 0 1280x720x24"]
DAY_GB_OF_4BFB91EA = 1.63  # the same picture


def need(program):
    if subprocess.run(["which", program], capture_output=True).returncode != 0:
        raise Skipped(f"needs the program {program}")


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def seconds(words):
    began = time.monotonic()
    run(*words)
    return time.monotonic() - began


def look_at(picture):
    """Refuses a picture that shows nothing: a background alone has no pixels that differ from the one to their left."""
    rows = pixels(picture.read_bytes())
    if f"{len(rows[0])}x{len(rows)}" != SIZE:
        raise RuntimeError(f"{picture.name} has {len(rows[0])}x{len(rows)} pixels in place of {SIZE}")
    edges = sum(max(abs(a - b) for a, b in zip(left, here)) > 16 for row in rows for left, here in zip(row, row[1:]))
    if edges < 500:
        raise RuntimeError(f"{picture.name} shows nothing: {edges} pixels differ from the one to their left")


def seconds_of_picture(words, picture):
    picture.unlink(missing_ok=True)
    took = seconds(words)
    look_at(picture)
    return took


def name_of(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/comm").read_text().strip()
    except OSError:
        return ""


def children(pid):
    try:
        tasks = list(pathlib.Path(f"/proc/{pid}/task").iterdir())
        found = [int(child) for task in tasks for child in (task / "children").read_text().split()]
    except OSError:
        return []
    return [pid] + [each for child in found for each in children(child)]


def proportional_kb(pid):
    try:
        lines = pathlib.Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith("Pss:")), 0)


def peak_gb(words, program="parvis"):
    """The largest memory of a program and its children; other processes of the command line, such as a display, do not count."""
    process = subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    peak, ended = 0, threading.Event()

    def watch():
        nonlocal peak
        while not ended.wait(0.02):
            own = next((pid for pid in children(process.pid) if name_of(pid) == program), None)
            if own:
                peak = max(peak, sum(proportional_kb(pid) for pid in children(own)))

    watcher = threading.Thread(target=watch)
    watcher.start()
    status = process.wait()
    ended.set()
    watcher.join()
    if status != 0:
        raise RuntimeError(f"{words[0]} ended with status {status}")
    if peak == 0:
        raise RuntimeError(f"no process named {program} was seen")
    return peak * 1024 / 1e9


def city():
    """The paper's city with its maps, made once."""
    place = FOLDER / "paper"
    if not (place / "paper.xp").exists():
        run(PARVIS, "city", "paper", "-o", place)
        run(PARVIS, "bake", place / "paper.xp")
    if not (FOLDER / "city.glb").exists():
        run(PARVIS, "export", place / "paper.xp", "-o", FOLDER / "city.glb")
    street = next(line for line in (place / "paper.xp").read_text().splitlines() if line.startswith('camera(name="street"'))
    (FOLDER / "city.xp").write_text(f'model(name="city", file="city.glb")\n{street}\n')  # f3d takes the first camera of the file
    return place


def render(scene, *more, size=SIZE):
    return [PARVIS, "render", scene, "--size", size, "-o", FOLDER / "picture.png", *more]


def f3d(*more):
    return [*DISPLAY, "f3d", "--quiet", "--resolution=1280,720", "--camera-index=0", f"--output={FOLDER / 'f3d.png'}", FOLDER / "city.glb", *more]


def model(figures, quick):
    """A bare model: its first picture and its memory, beside f3d."""
    need("f3d"), need("xvfb-run")
    city()
    ours, theirs, display = [], [], []

    def ours_of(size):
        return render(FOLDER / "city.xp", "--camera", "street", size=size)

    for _ in range(3 if quick else 7):
        display.append(seconds([*DISPLAY, "true"]))
        ours.append(seconds_of_picture(ours_of(SIZE), FOLDER / "picture.png"))
        theirs.append(seconds_of_picture(f3d(), FOLDER / "f3d.png") - display[-1])
    print(f"  parvis {ours}\n  f3d {theirs}")
    figures["start_s"], figures["start_s_of_f3d"] = statistics.median(ours), statistics.median(theirs)
    figures["start_over_f3d"] = figures["start_s"] / figures["start_s_of_f3d"]
    figures["start_over_f3d_of_16_times_the_pixels"] = seconds(ours_of(LARGE)) / figures["start_s_of_f3d"]
    figures["peak_gb_of_f3d"] = peak_gb(f3d(), "f3d")
    figures["peak_gb"] = peak_gb(ours_of(SIZE))
    figures["peak_memory_over_f3d"] = figures["peak_gb"] / figures["peak_gb_of_f3d"]
    figures["peak_memory_over_f3d_of_16_times_the_pixels"] = peak_gb(ours_of(LARGE)) / figures["peak_gb_of_f3d"]


def day(figures, _quick):
    """The paper's day: memory of its picture."""
    scene = city() / "paper_day.xp"
    figures["peak_memory_over_today"] = peak_gb(render(scene)) / DAY_GB_OF_4BFB91EA
    figures["peak_memory_over_today_of_16_times_the_pixels"] = peak_gb(render(scene, size=LARGE)) / DAY_GB_OF_4BFB91EA


def window(figures, quick):
    """The window of the baked city: from the command to its end after the first picture."""
    need("xvfb-run")
    place = city()
    view = [*DISPLAY, PARVIS, "view", place / "paper.xp", "--size", SIZE, "--camera", "street", "--sound", "off"]
    times = []
    for _ in range(3 if quick else 5):
        times.append(seconds([*view, "--frames", "1"]) - seconds([*DISPLAY, "true"]))
    print(f"  {times}")
    figures["first_window_picture_s"] = statistics.median(times)
    figures["first_window_picture_s_of_100_frames"] = seconds([*view, "--fps", "off", "--frames", "100"]) - seconds([*DISPLAY, "true"])


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    main("start", {"model": model, "day": day, "window": window})
