#!/usr/bin/env python3
"""Measures the editor as a user feels it, on a machine that does nothing else; prints a table.

    tests/editor/measure_editor.py [--raylab build/release/raylab] [--seconds 20] [SCENE...]

For each scene, in a window of 1280 x 720 on an Xvfb of its own, with real events from xdotool: the time from the
start of the program to the first picture, and from an input event to the frame that shows it while the picture is
rendered (pointer moves, keys that fly, drags that turn the view). Then one editor opens ten scenes after each other,
and its resident memory is read after each. Needs xvfb-run and xdotool. Scenes are files or names of raylab's own.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCREEN = "-screen 0 1280x720x24"
PATIENCE = 600.0  # seconds that anything may take


def existing(folder, name, process):
    """Waits for a file that the editor writes."""
    end = time.monotonic() + PATIENCE
    while not (folder / name).exists():
        if process.poll() is not None:
            sys.exit(f"the editor ended early; its log is {folder / 'log'}")
        if time.monotonic() > end:
            sys.exit(f"nothing after {PATIENCE:.0f} s; the log is {folder / 'log'}")
        time.sleep(0.02)


def start_editor(raylab, folder, arguments, script, user=""):
    """xvfb-run with the editor, and beside it a shell script as its user. The editor's process id comes in `pid`."""
    (folder / "script").write_text(script)
    (folder / "user.sh").write_text(user)
    (folder / "both.sh").write_text(
        f"'{raylab}' edit {arguments} --script script > log 2>&1 & editor=$!\n"
        "echo $editor > pid.new; mv pid.new pid\n"
        "export WINDOW=$(timeout 60 xdotool search --sync --onlyvisible --name raylab | head -n 1)\n"
        "sh ./user.sh\nwait $editor\n")
    environment = dict(os.environ, XDG_CONFIG_HOME=str(folder), XDG_STATE_HOME=str(folder))
    return subprocess.Popen(["xvfb-run", "-a", "-s", SCREEN, "sh", "./both.sh"], cwd=folder, env=environment)


def hand(seconds):
    """What the user does for so long: moves over the picture, flies, turns the view."""
    rounds = max(int(seconds / 2.0), 1)
    return ("xdotool windowfocus --sync $WINDOW\nwhile [ ! -e ready ]; do sleep .05; done\n"
            f"for round in $(seq {rounds}); do\n"
            "for i in $(seq 16); do xdotool mousemove $((420 + 14 * i)) $((260 + 4 * i)); sleep .025; done\n"
            "xdotool keydown w; sleep .25; xdotool keyup w\n"
            "xdotool mousemove 560 300 mousedown 3\n"
            "for i in $(seq 12); do xdotool mousemove_relative 6 1; sleep .025; done\nxdotool mouseup 3\n"
            "xdotool keydown s; sleep .25; xdotool keyup s\nsleep .3\ndone\ntouch moved\n")


def measure_scene(raylab, scene, seconds):
    folder = Path(tempfile.mkdtemp(prefix="raylab-measure-"))
    script = ("timeout 600\nwait-open\nwait-samples 1\nscreenshot ready\nreset-latency\n"
              f"wait {1.6 * seconds + 2.0:.1f}\nreport-latency latency.json\nquit\n")
    began = time.monotonic()
    process = start_editor(raylab, folder, f"'{scene}' --spp 100000", script, hand(seconds))
    existing(folder, "ready", process)
    opened = time.monotonic() - began
    existing(folder, "latency.json", process)
    process.wait()
    latency = json.loads((folder / "latency.json").read_text())
    shutil.rmtree(folder)
    return opened, latency["frames"], latency["milliseconds"]


def resident_mib(pid):
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024.0
    return float("nan")


def measure_memory(raylab, scenes):
    """Resident MiB after each of ten scenes, once it has a picture."""
    folder = Path(tempfile.mkdtemp(prefix="raylab-measure-"))
    order = [scenes[i % len(scenes)] for i in range(10)]
    script = "timeout 600\nwait-open\nwait-samples 1\n"
    for i, scene in enumerate(order):
        script += f'open "{scene}"\nwait-open\nwait 1\nwait-samples 1\nscreenshot mark-{i}\nwait 1\n'
    process = start_editor(raylab, folder, f"'{order[0]}' --spp 2", script + "quit\n")
    memory = []
    for i in range(len(order)):
        existing(folder, f"mark-{i}", process)
        memory.append(resident_mib(int((folder / "pid").read_text())))
    process.wait()
    shutil.rmtree(folder)
    return list(zip(order, memory))


def scene_file(text, raylab):
    """The file of a scene; raylab's own lie beside the program."""
    own = raylab.parent / "assets" / f"{text}.glb"
    path = Path(text) if Path(text).exists() else own
    if not path.exists():
        sys.exit(f"{text}: there is no such scene")
    return path.resolve()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=["courtyard", "cornell", "mirrors"])
    parser.add_argument("--raylab", default="build/release/raylab", type=Path)
    parser.add_argument("--seconds", default=20.0, type=float, help="of input for each scene")
    parser.add_argument("--no-memory", action="store_true", help="leave out the ten scenes")
    options = parser.parse_args()
    for tool in ("xvfb-run", "xdotool"):
        if shutil.which(tool) is None:
            sys.exit(f"{tool} is not installed")
    raylab = options.raylab.resolve()
    if not raylab.exists():
        sys.exit(f"{raylab}: is not built; give --raylab")
    scenes = [scene_file(text, raylab) for text in options.scenes]

    print("| scene | start to first picture, s | frames | input to frame: p50, ms | p99, ms | worst, ms |")
    print("|---|---|---|---|---|---|")
    for scene in scenes:
        opened, frames, ms = measure_scene(raylab, scene, options.seconds)
        print(f"| {scene.stem} | {opened:.2f} | {frames} | {ms['p50']:.1f} | {ms['p99']:.1f} | {ms['worst']:.1f} |",
              flush=True)
    if options.no_memory:
        return
    print("\n| opened | scene | resident memory, MiB |\n|---|---|---|")
    for i, (scene, mib) in enumerate(measure_memory(raylab, scenes), 1):
        print(f"| {i} | {scene.stem} | {mib:.0f} |")


if __name__ == "__main__":
    main()
