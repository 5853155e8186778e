"""Numbers that are none, infinite, negative, or wrap: on the command line and in scripts."""

from .case import CAMERA, Case, scene, write

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"
BAD = ["nan", "-nan", "inf", "-inf", "1e400", "-1", "-1e300", "4294967360", "18446744073709551617", "0x", "1,5", "", " ", "--"]


def command_line(option, value, expects="refused"):
    def build(folder):
        write(folder, "t.obj", TRIANGLE)
        script = scene(folder, 'model(file="t.obj")\n' + CAMERA)
        render = ["render", script, "-o", "out.png"]
        photograph = ["reference", script, "--path-traced", "-o", "out.png"]
        small = ["--size", "16x16"]
        circle = ["--circle", "0,0,0,5,1,2"]
        commands = {
            "time": [*render, *small, f"--time={value}"],
            "seconds": ["render", script, "-o", "out.mp4", *small, f"--seconds={value}"],
            "fps": ["render", script, "-o", "out.mp4", *small, "--seconds", "1", f"--fps={value}"],
            "size": [*render, f"--size={value}x16"],
            "height": [*render, f"--size=16x{value}"],
            "supersample": [*render, *small, f"--supersample={value}"],
            "fov": [*photograph, *small, "--samples", "1", *circle, f"--fov={value}"],
            "clamp": [*photograph, *small, "--samples", "1", f"--clamp={value}"],
            "seed": [*photograph, *small, "--samples", "1", f"--seed={value}"],
            "samples": [*photograph, *small, f"--samples={value}"],
            "bounces": [*photograph, *small, "--samples", "1", f"--bounces={value}"],
            "circle x": [*photograph, *small, "--samples", "1", f"--circle={value},0,0,5,1,2"],
            "circle radius": [*photograph, *small, "--samples", "1", f"--circle=0,0,0,{value},1,2"],
            "circle eye": [*photograph, *small, "--samples", "1", f"--circle=0,0,0,5,{value},2"],
            "circle count": [*photograph, *small, "--samples", "1", f"--circle=0,0,0,5,1,{value}"],
            "press": [*render, *small, f"--press=h@{value}"],
            "city seed": ["city", "kitchen", "-o", "city", f"--seed={value}"],
            "sun cell": ["sun", script, "--from", "2026-06-21", "--place", "52", "4", f"--cell={value}"],
            "sun place": ["sun", script, "--from", "2026-06-21", "--place", value, "4"],
            "sun area": ["sun", script, "--from", "2026-06-21", "--place", "52", "4", "--area", value, "0", "1", "1"],
        }
        return [commands[option]]

    harmless = option in ("circle x", "circle eye") and value.startswith(("4294967360", "-1"))
    if option == "clamp" and value.startswith(("4294967360", "18446744073709551617")):
        expects = "done"  # much light, and a number
    return Case("command line", f"{option}={value}", build, "either" if harmless else expects)


OPTIONS = ["time", "seconds", "fps", "size", "height", "supersample", "fov", "clamp", "seed", "samples", "bounces",
           "circle x", "circle radius", "circle eye", "circle count", "press", "city seed", "sun cell", "sun place",
           "sun area"]
SCRIPTS = {
    "eye on target": 'camera(name="c", position="1 2 3", target="1 2 3")',
    "eye nearly on target": 'camera(name="c", position="1 2 3", target="1 2 3.00001")',
    "looks straight up": 'camera(name="c", position="0 0 0", target="0 0 5")',
    "far eye": 'camera(name="c", position="1e9 1e9 1e9", target="0 0 0")',
    "farther eye": 'camera(name="c", position="1e30 0 0", target="0 0 0")',
    "nan": 'camera(name="c", position="nan 0 0")',
    "infinite": 'camera(name="c", position="inf 0 0")',
    "empty scene": "sun()",
    "empty scene with a camera": CAMERA,
    "follows from nowhere": 'model(file="t.obj", name="m", dynamic=1)\ncamera(name="c", follows="m", offset="0 0 0")',
    "follows from its target": 'model(file="t.obj", name="m", dynamic=1)\ncamera(name="c", follows="m", offset="0 0 0.8")',
    "scale 1e60": 'model(file="t.obj", scale=1e60)\n' + CAMERA,
    "nested scales": "group(scale=1e6) {" * 10 + 'model(file="t.obj")' + "}" * 10 + "\n" + CAMERA,
    "nested small scales": "group(scale=1e-6) {" * 10 + 'model(file="t.obj")' + "}" * 10 + "\n" + CAMERA,
    "camera in scaled groups": "group(scale=1e-6) {" * 10 + CAMERA + "}" * 10,
    "camera far in groups": 'group(position="1e9 1e9 0", scale=1e6) {' * 4 + CAMERA + "}" * 4,
    "negative scale": 'model(file="t.obj", scale=-1)',
    "nan scale": 'model(file="t.obj", scale=nan)',
    "positions far": 'model(file="t.obj", positions="1e9 1e9, -1e9 -1e9")\n' + CAMERA,
    "fov 0": 'camera(name="c", fov_deg=0)',
    "sun of nan": "sun(azimuth_deg=nan)",
    "exposure 1e300": "exposure(value=1e300)",
    "heading 1e300": 'camera(name="c", heading_deg=1e300)',
    "haze -1": "air(haze_per_m=-1)",
}


def script_case(name, text, command):
    def build(folder):
        write(folder, "t.obj", TRIANGLE)
        script = scene(folder, text)
        size = ["--size", "16x16"]
        return [{
            "check": ["check", script],
            "trace": ["reference", script, *size, "--samples", "1", "-o", "out.png"],
            "photograph": ["reference", script, *size, "--samples", "1", "--path-traced", "-o", "out.png"],
            "render": ["render", script, *size, "-o", "out.png"],
            "export": ["export", script, "-o", "out.glb"],
        }[command]]

    return Case("script", f"{name}, {command}", build, needs_gl=command in ("trace", "render"))


def cases():
    yield from (command_line(option, value) for option in OPTIONS for value in BAD
                if not (option in ("seed", "city seed", "samples") and value in ("4294967360",)))
    yield from (script_case(name, text, command) for name, text in SCRIPTS.items()
                for command in ("check", "trace", "photograph", "render", "export"))
