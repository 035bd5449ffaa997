#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The report in a browser and on paper: no network, nothing clipped or overlapping, readable text.

Slow: only in `make check-all`, with Debian's chromium and poppler-utils.
"""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import FULL, PATIENCE, PROFILES, SANITIZED, Folder, Skip, expect, expect_equal, good, run_all  # noqa: E402

SCENES = sorted(path.stem for path in (PROFILES / "scenes").glob("*.yaml"))
# eight options with all outputs of a scene
EVERYTHING = ("-s", "blocks={per_year: 0.5, volume_m3: [0.01, 2], exponent: 1.1}", "-s", "rules=toscana", "-s",
              "design={survey: good, blocks: poor}", "-s",
              "controls=[{x_m: 100, name: path, accepted_kJ: 30}, {x_m: 135, name: road, accepted_kJ: 50}]", "-s",
              "page={place: Serra, owner: Comune, parcel: 12, author: A. Rossi, date: 24/11/2026, note: prot. 1402}", "-s",
              "observed=[{name: marks, passed: {x_m: 100, count: 8, of: 10}}]")
QUICK = ("-n", 2000, "--sensitivity=8")

# Checks every element with its own text: boxes, colours, and whether it stays in its place.
LOOK = r"""
(() => {
  const found = {problems: [], resources: performance.getEntriesByType('resource').length, texts: 0};
  const say = (what, e) => found.problems.push(what + ': ' + e.tagName + ' "' + e.textContent.trim().slice(0, 60) + '"');
  const luminance = c => {
    const [r, g, b] = c.map(v => { v /= 255; return v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4; });
    return .2126 * r + .7152 * g + .0722 * b;
  };
  const rgba = c => c.match(/[\d.]+/g).map(Number);
  const paper = e => {
    for (; e; e = e.parentElement) {
      const c = rgba(getComputedStyle(e).backgroundColor);
      if (c.length < 4 || c[3] > 0) return c.slice(0, 3);
    }
    return [255, 255, 255];
  };
  // Returns the fill of the last rectangle drawn below a text of a picture, or what is behind the picture.
  const ground = (e, svg) => {
    const t = e.getBoundingClientRect(), middle = (t.top + t.bottom) / 2;
    for (let r = e.previousElementSibling; r; r = r.previousElementSibling) {
      const b = r.getBoundingClientRect(), fill = getComputedStyle(r).fill;
      const below = b.left < t.left + 1 && b.right > t.right - 1 && b.top < middle && b.bottom > middle;
      if (r.tagName === 'rect' && fill !== 'none' && below) return rgba(fill).slice(0, 3);
    }
    return paper(svg);
  };
  const boxes = [];
  const right = document.body.getBoundingClientRect().right + 1;
  for (const e of document.querySelectorAll('body *:not(script):not(style):not(title):not(desc)')) {
    const own = [...e.childNodes].filter(n => n.nodeType === 3 && n.data.trim());
    if (!own.length) continue;
    found.texts++;
    const style = getComputedStyle(e), svg = e.closest('svg');
    const ink = rgba(svg ? style.fill : style.color).slice(0, 3);
    const [a, b] = [luminance(ink), luminance(svg ? ground(e, svg) : paper(e))].sort((x, y) => y - x);
    if ((a + .05) / (b + .05) < 4.5) say('contrast ' + ((a + .05) / (b + .05)).toFixed(2), e);
    if (!svg && (e.scrollWidth > e.clientWidth + 1) && style.display !== 'inline') say('clipped', e);
    const within = svg ? svg.getBoundingClientRect() : {left: -1, right, top: -1, bottom: 1e9};
    for (const n of own) {
      const range = document.createRange();
      range.selectNodeContents(n);
      for (const r of svg ? [e.getBoundingClientRect()] : range.getClientRects()) {
        if (r.width < 1) continue;
        if (r.left < within.left - 1 || r.right > within.right + 1 || r.bottom > within.bottom + 2) say('outside', e);
        boxes.push([r, e]);
      }
    }
  }
  for (let i = 0; i < boxes.length; i++)
    for (let k = i + 1; k < boxes.length; k++) {
      const [r, e] = boxes[i], [s, f] = boxes[k];
      if (e === f) continue;
      const across = Math.min(r.right, s.right) - Math.max(r.left, s.left);
      const down = Math.min(r.bottom, s.bottom) - Math.max(r.top, s.top);
      if (across > 1.5 && down > 0.35 * Math.min(r.height, s.height)) { say('overlap', e); say('  with', f); }
    }
  const out = document.createElement('pre');
  out.id = 'found';
  out.textContent = JSON.stringify(found);
  document.body.append(out);
})();
"""


def chromium(folder, *arguments):
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if not program:
        raise Skip("no chromium")
    command = [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=794,1123",
               "--proxy-server=127.0.0.1:1", f"--user-data-dir={folder}/browser", *arguments]
    env = {**os.environ, "HOME": str(folder), "XDG_CONFIG_HOME": str(folder), "XDG_CACHE_HOME": str(folder)}
    return subprocess.run(command, env=env, capture_output=True, text=True, timeout=PATIENCE, check=True).stdout


def report(folder, scene, language, *more):
    path = folder / f"{scene}-{language}.html"
    good("--report", path, "--language", language, *QUICK, *more, scene)
    return path


def measure_page(folder, path):
    """Return the browser's findings on the page, on a screen as wide as the paper."""
    seen = folder / "look.html"
    seen.write_text(path.read_text(encoding="utf-8").replace("</body>", f"<script>{LOOK}</script></body>"), encoding="utf-8")
    dom = chromium(folder, "--virtual-time-budget=5000", "--dump-dom", seen.as_uri())
    return json.loads(html.unescape(re.search(r'<pre id="found">(.*?)</pre>', dom, re.S).group(1)))


def words_on_paper(pdf):
    """Return pages, each with its size and the boxes of its words."""
    text = subprocess.run(["pdftotext", "-bbox", pdf, "-"], capture_output=True, check=True).stdout.decode("utf-8", "replace")
    text = re.sub(r"<!DOCTYPE.*?>", "", text, flags=re.S).replace(' xmlns="http://www.w3.org/1999/xhtml"', "")
    for page in ElementTree.fromstring(text).iter("page"):
        yield (float(page.get("width")), float(page.get("height")),
               [(*(float(word.get(k)) for k in ("xMin", "yMin", "xMax", "yMax")), word.text or "") for word in page.iter("word")])


def check_paper(folder, path):
    """A4, 2 to 4 pages, no word outside the margins or over another, no page almost empty except the last"""
    pdf = folder / "page.pdf"
    chromium(folder, "--no-pdf-header-footer", f"--print-to-pdf={pdf}", path.as_uri())
    pages = list(words_on_paper(pdf))
    expect(2 <= len(pages) <= 4, f"{path.name}: {len(pages)} pages")
    margin = 9 / 25.4 * 72
    for number, (width, height, words) in enumerate(pages, 1):
        expect(abs(width - 595) < 1.5 and abs(height - 842) < 1.5, width, height)
        expect(words, f"page {number} is empty")
        outside = [w for w in words if w[0] < margin or w[2] > width - margin or w[1] < margin or w[3] > height - margin]
        expect(not outside, f"{path.name}, page {number}: outside the margins", outside[:5])
        over = [(a, b) for i, a in enumerate(words) for b in words[i + 1:]
                if min(a[2], b[2]) - max(a[0], b[0]) > 1 and min(a[3], b[3]) - max(a[1], b[1]) > 0.5 * min(a[3] - a[1], b[3] - b[1])]
        expect(not over, f"{path.name}, page {number}: over one another", over[:5])
    # the two tables of percentiles, with and without forest, are on one sheet
    heads = [[len(re.findall(rf"\b(?:{word}), \d+ (?:of|su) \d+", " ".join(w[4] for w in words)))
              for word in ("forest|bosco", "without|senza")] for _, _, words in pages]
    expect(all(n == others for n, others in heads), f"{path.name}: a table cut from its other half", heads)
    tables = re.findall(r">(?:without|senza), \d+ (?:of|su) \d+", path.read_text(encoding="utf-8"))
    expect_equal(sum(n for n, _ in heads), len(tables), path.name)


def check_report(scene, language, *more):
    with Folder() as f:
        path = report(f.path, scene, language, *more)
        text = path.read_text(encoding="utf-8")
        expect(len(text.encode()) <= 400_000, f"{len(text)} bytes")
        found = measure_page(f.path, path)
        expect(found["texts"] > 100, found)
        expect_equal(found["resources"], 0, "asked of a network")
        expect_equal(found["problems"], [], f"{scene}, {language}")
        check_paper(f.path, path)
        if shutil.which("tidy"):
            done = subprocess.run(["tidy", "-q", "-e", "-utf8"], input=text, capture_output=True, text=True, check=False)
            expect_equal((done.returncode, done.stderr), (0, ""), scene)


def test_reports():
    """Each scene in each language: contrast, boxes, resources, 2 to 4 sheets of A4, tidy"""
    if not FULL or SANITIZED:
        raise Skip("for make check-all")
    for scene in SCENES:
        for language in ("en", "it"):
            check_report(scene, language)
    for language in ("en", "it"):
        check_report("four-systems", language, *EVERYTHING)


if __name__ == "__main__":
    run_all(__name__)
