"""How much sooner settings reach the same error, by the noise of pairs of renderings: no reference is needed.

    equal_time.py RAYLAB "SCENE and common options" "options of A|options of B|..." [PAIRS]

Half of the squared difference between two seeds is the squared error of one picture, where both converge to the same. Gain: error x
seconds of the first options over those of each, in turn with the same pairs of seeds; median, and the least and the largest of the pairs.
"""
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

raylab, common, pairs = sys.argv[1], sys.argv[2].split(), int(sys.argv[4]) if len(sys.argv) > 4 else 3
options = [text.strip() for text in sys.argv[3].split("|")]
rows = {text: [] for text in options}
with tempfile.TemporaryDirectory() as folder:
    for pair in range(pairs):
        for text in options:
            files, seconds = [], []
            for seed in (2 * pair + 1, 2 * pair + 2):
                image, report = Path(folder) / f"{seed}.exr", Path(folder) / "report.json"
                subprocess.run([raylab, "render", *common, *text.split(), "--seed", str(seed), "-o", image, "--json", report, "--quiet"],
                               check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                seconds.append(json.loads(report.read_text())["seconds"]["render"])
                files.append(image)
            figures = json.loads(subprocess.run([raylab, "compare", *files, "--json", "-"], check=True, capture_output=True).stdout)
            rows[text].append((statistics.mean(seconds), figures["relMse"] / 2, figures["mse"] / 2))
for text in options:
    gains = [a[0] * a[1] / (b[0] * b[1]) for a, b in zip(rows[options[0]], rows[text])]
    seconds, rel_mse, mse = (statistics.median(column) for column in zip(*rows[text]))
    print(f"{text or '(as they are)':34} {seconds:8.3f} s  relMSE {rel_mse:.3e}  MSE {mse:.3e}  "
          f"gain {statistics.median(gains):.2f} ({min(gains):.2f} to {max(gains):.2f})")
