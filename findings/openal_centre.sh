#!/usr/bin/env bash
# OpenAL Soft never feeds the centre loudspeaker of 5.1 and 7.1: a source straight ahead comes from left and right alone.
. "$(dirname "$0")/packages.sh"
need libopenal1=1:1.19.1-2
cat > centre.py <<'PY'
"""Renders a source straight ahead through a loopback device and prints the level of each loudspeaker."""
import array, ctypes, math
al = ctypes.CDLL("libopenal.so.1")
al.alcGetProcAddress.restype = ctypes.c_void_p
def function(name, result, *arguments):
    return ctypes.CFUNCTYPE(result, *arguments)(al.alcGetProcAddress(None, name))
pointer, integer = ctypes.c_void_p, ctypes.c_int
device = function(b"alcLoopbackOpenDeviceSOFT", pointer, ctypes.c_char_p)(None)
render = function(b"alcRenderSamplesSOFT", None, pointer, pointer, integer)
al.alcCreateContext.restype, al.alcCreateContext.argtypes = pointer, [pointer, pointer]
al.alcMakeContextCurrent.argtypes = [pointer]
FREQUENCY, FORMAT, TYPE, FLOAT, HRTF = 0x1007, 0x1990, 0x1991, 0x1406, 0x1992
for name, layout, speakers in (("5.1", 0x1504, ["left", "right", "centre", "low", "rear left", "rear right"]),
                               ("7.1", 0x1506, ["left", "right", "centre", "low", "rear left", "rear right", "side left", "side right"])):
    wanted = (integer * 9)(FORMAT, layout, TYPE, FLOAT, FREQUENCY, 48000, HRTF, 0, 0)
    context = al.alcCreateContext(device, wanted)
    assert context and al.alcMakeContextCurrent(context)
    buffer, source = ctypes.c_uint(), ctypes.c_uint()
    al.alGenBuffers(1, ctypes.byref(buffer)), al.alGenSources(1, ctypes.byref(source))
    tone = array.array("h", (int(20000 * math.sin(2 * math.pi * 440 * i / 48000)) for i in range(48000)))
    al.alBufferData(buffer, 0x1101, tone.tobytes(), len(tone) * 2, 48000)  # AL_FORMAT_MONO16
    al.alSourcei(source, 0x1009, buffer)  # AL_BUFFER
    al.alSource3f.argtypes = [ctypes.c_uint, integer, ctypes.c_float, ctypes.c_float, ctypes.c_float]
    al.alSource3f(source, 0x1004, 0.0, 0.0, -2.0)  # AL_POSITION: straight ahead
    al.alSourcePlay(source)
    count = len(speakers)
    samples = (ctypes.c_float * (count * 24000))()
    render(device, samples, 24000)
    levels = [math.sqrt(sum(samples[i * count + c] ** 2 for i in range(4800, 24000)) / 19200) for c in range(count)]
    print(name, ", ".join(f"{speaker} {level:.4f}" for speaker, level in zip(speakers, levels)))
    al.alcMakeContextCurrent(None)
    al.alcDestroyContext.argtypes = [pointer]
    al.alcDestroyContext(context)
PY
ALSOFT_LOGLEVEL=0 python3 centre.py | tee levels.txt
is_found() { [ "$(grep -c 'left 0\.0*[1-9].*centre 0\.0000' levels.txt)" -eq 2 ]; }
expect "the centre is silent in 5.1 and 7.1, left and right are not" is_found
