"""Script time per frame and size of the replay of a flight of five minutes, in headless Chromium.

The frames are drawn by the processor, so their number per second is not that of a GPU. Their script time is measured in the page.
"""

import json
import pathlib
import shutil
import subprocess

import flights

FRAMES, LONGEST_S = 150, 40
GOAL_MS, GOAL_MB = 8.0, 10.0
STEPS = f"""
  const pause = (ms) => new Promise((done) => setTimeout(done, ms)), begin = performance.now();
  document.getElementById('play').click();
  await pause(3000);  // textures and shaders are ready
  replay.frame_ms.length = 0;
  while (replay.frame_ms.length < {FRAMES} && performance.now() - begin < 1000 * {LONGEST_S}) await pause(200);
  return [...replay.frame_ms].sort((a, b) => a - b);
"""


def frame_ms(root, page):
    """Returns the sorted script times of the frames, ms."""
    request = json.dumps({"page": str(page), "steps": STEPS, "width": 1400, "height": 900})
    done = subprocess.run(["node", root / "tests/sim/pages/browser.mjs", "chromium"], input=request + "\n", capture_output=True,
                          check=True, text=True)
    answer = json.loads(done.stdout)
    if answer.get("failed") or answer.get("errors"):
        raise SystemExit(f"{page}: {answer.get('failed') or answer['errors']}")
    return answer["value"]


def run(root, hedgehop):
    if not shutil.which("chromium") or not shutil.which("node"):
        print("\nreplay: needs chromium and node")
        return
    out, flown_s = flights.long_flight(root, hedgehop)
    subprocess.run([hedgehop, "report", "--replay", out], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    page = pathlib.Path(out) / "replay.html"
    times, size_mb = frame_ms(root, page), page.stat().st_size / 1e6
    median, p95 = times[len(times) // 2], times[int(0.95 * len(times))]
    missed = "" if median <= GOAL_MS and size_mb <= GOAL_MB else "   MISSED"
    print(f"\nreplay of a flight of {flown_s:.0f} s: script time {median:.1f} ms per frame (median of {len(times)}; 95 % below {p95:.1f} ms), "
          f"{size_mb:.2f} MB; goal {GOAL_MS:g} ms, {GOAL_MB:g} MB{missed}", flush=True)
