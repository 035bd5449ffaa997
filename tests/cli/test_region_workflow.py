#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow uncounted
"""profiles/region: lines of fall on a plane, refused rasters, and a small valley whose files change. `make check-all` also kills a
run; beside a Slurm its jobs are Slurm's."""
import csv
import math
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import CEDUO, FULL, PATIENCE, ROOT, Folder, Skip, environment, expect, expect_equal, expect_in, expect_near, run_all  # noqa: E402

SLURM = "SLURM_CONF" in os.environ
PYTHON = "/usr/bin/python3"  # the packages of Debian are its own
PLANE = """\
import numpy as np
from osgeo import gdal
for path, array, kind in (("terrain.tif", np.arange(59, -1, -1)[:, None] * 5 * {tan} + np.zeros(40), 6), ("stands.tif", np.ones((60, 40)), 1)):
    out = gdal.GetDriverByName("GTiff").Create(path, 40, 60, 1, kind)
    out.SetGeoTransform((400000, 5, 0, 5000000, 0, -5))
    out.SetProjection("EPSG:32632")
    out.GetRasterBand(1).WriteArray(array)
"""

FELLED = """\
from osgeo import gdal
source = gdal.Open("stands.tif", 1)
codes = source.ReadAsArray()
codes[:, :8] = 3
source.GetRasterBand(1).WriteArray(codes)
"""

POLYGONS = """\
from osgeo import gdal, ogr
source = gdal.Open("codes.tif")
to = ogr.GetDriverByName("GPKG").CreateDataSource("polygons.gpkg")
layer = to.CreateLayer("stands", source.GetSpatialRef())
layer.CreateField(ogr.FieldDefn("code", ogr.OFTInteger))
gdal.Polygonize(source.GetRasterBand(1), None, layer, 0)
"""


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def command(folder, *words, status=0):
    env = environment(HOME=str(folder), USER=os.environ.get("USER", "root"), PYTHONDONTWRITEBYTECODE="1")
    done = subprocess.run(words, cwd=folder, env=env, capture_output=True, text=True, timeout=PATIENCE, check=False)
    expect_equal(done.returncode, status, " ".join(words) + done.stdout + done.stderr)
    return done.stdout + done.stderr


def change(path, *pairs):
    text = path.read_text(encoding="utf-8")
    for old, new in pairs:
        expect_in(old, text, path)
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")


def region(f, length=300, rocks=40):
    """Copy the workflow, for a short valley, few rocks and one year. Its code 1 has a stand of its own."""
    if not shutil.which("snakemake") or not shutil.which("ogr2ogr"):
        raise Skip("snakemake or gdal-bin is not installed")
    to = f.path / "region"
    shutil.copytree(ROOT / "profiles/region", to)
    change(to / "config.yaml", ("valley_m: 1000", f"valley_m: {length}"), ("rocks: 300", f"rocks: {rocks}"), ("job: 20", "job: 6"),
           ("  1: [talus, simple-coppice,", "  1: [talus, mine.yaml,"))
    with open(to / "config.yaml", "a", encoding="utf-8") as file:
        file.write(f"ceduo: '{CEDUO}'\n")
    with open(to / "region.yaml", "a", encoding="utf-8") as file:
        file.write("years: {first: 0, last: 0}\n")
    shutil.copy(ROOT / "profiles/stands/simple-coppice.yaml", to / "mine.yaml")
    return to


def snakemake(folder, *words, **more):
    """Run the workflow; return its jobs, each by its rule and, if it has one, its piece."""
    said = command(folder, "snakemake", *(words or ("--cores", "2")), **more)
    jobs = re.split(r"(?m)^(?:local)?(?:rule|checkpoint) ", said)[1:]
    return sorted(job.split(":")[0] + "".join(re.findall(r"wildcards: piece=(\S+)", job)) for job in jobs)


def layers(folder):
    """Return the rows of each layer."""
    db = sqlite3.connect(folder / "verdicts.gpkg")
    db.row_factory = sqlite3.Row
    names = [row[0] for row in db.execute("SELECT table_name FROM gpkg_contents")]
    found = {name: [dict(row) for row in db.execute(f"SELECT * FROM {name}")] for name in names}
    db.close()
    return found


def results(folder):
    return {name: (folder / name).read_bytes() for name in ("map.csv", "stretches.csv", "verdicts.gpkg", "region.html")}


def expect_complete(folder, failed=()):
    """Expect a row for each line and option, and for each stretch and option, whatever failed."""
    found, options = layers(folder), ["now", "cut", "selection"]
    lines, stretches = rows(folder / "lines.csv"), rows(folder / "stretches.csv")
    steepest = {line["id"] for line in lines if line["way"] == "steepest"}
    table = [(row["id"], row["option"]) for row in rows(folder / "map.csv")]
    expect_equal(sorted(table), sorted((i, o) for i in (line["id"] for line in lines) for o in ([""] if i in failed else options)), "map.csv")
    expect_equal(sorted((r["id"], r["option"]) for r in found["verdicts"]), sorted((i, o) for i in steepest for o in options), "verdicts")
    expect_equal({r["id"] for r in found["lines"]}, steepest, "lines")
    expect_equal(sorted((r["stretch"], r["option"]) for r in found["spread"]),
                 sorted((s["stretch"], o) for s in stretches for o in options), "spread")
    expect_equal({r["stretch"] for r in found["not_judged"]}, {s["stretch"] for s in stretches} - {r["stretch"] for r in found["verdicts"]},
                 "not judged")
    expect(all(isinstance(r["class"], int) for r in found["verdicts"]), "classes", found["verdicts"][:3])
    expect_equal({r["id"] for r in found["verdicts"] if r["status"] == "failed"}, set(failed), "failed")
    expect_equal({r["class"] for r in found["verdicts"] if r["id"] in failed}, {5} if failed else set(), "class of a failed line")
    expect_equal(len(found["provenance"]), 1, "provenance")


def test_plane():
    """On a plane lines are straight, heights exact, and the area of a face is that of its cells over the cosine"""
    with Folder() as f:
        to, angle = region(f), math.radians(50)
        command(to, PYTHON, "-c", PLANE.format(tan=math.tan(angle)))
        ends = [[400000 + 5 * 5.5, 5000000 - 5 * 55.5], [400000 + 5 * 45.5, 5000000 - 5 * 55.5]]  # 28 m of it beside the terrain
        f.write("region/road.csv", 'wkt,name\n"LINESTRING ({} {}, {} {})",road\n'.format(*ends[0], *ends[1]))
        command(to, "ogr2ogr", "-a_srs", "EPSG:32632", "road.gpkg", "road.csv", "-oo", "GEOM_POSSIBLE_NAMES=wkt")
        change(to / "config.yaml", ("road: road.geojson", "road: road.gpkg"))
        command(to, PYTHON, "profiles.py", (to / "config.yaml").read_text())
        expect_equal({s["reason"] for s in rows(to / "stretches.csv")}, {"ok"}, "reasons")
        expect_equal({line["stretch"] for line in rows(to / "lines.csv")}, {f"0-{15 * i:05}" for i in range(12)}, "stretches")
        lines = [line for line in rows(to / "lines.csv") if line["stretch"] == "0-00015" and line["way"] == "steepest"]
        # Three columns of 57 cells: 55 above the road, that of the road and the one beside it.
        area = 3 * 57 * 25 / math.cos(angle)
        expect_equal([line["part"] for line in lines], ["high", "low"], "lines of a stretch")
        expect_near(sum(float(line["face_m2"]) for line in lines), area, 1, "area")
        expect_near(sum(float(line["blocks.per_year"]) for line in lines), 3 * area / 1e4, 1e-4, "blocks a year")
        profile = [(float(p["distance"]), float(p["elevation"])) for p in rows(to / lines[0]["slope.csv"])]
        expect_near(float(lines[0]["controls[0].x_m"]), 55 * 5, 0.01, "road")
        expect_near(profile[-1][0], 55 * 5 + 20, 0.01, "end")
        for x, h in profile:
            expect_near(h, (59 * 5 - x) * math.tan(angle), 0.02, f"height at {x}")
        for x, _ in re.findall(r"([-.\d]+) ([-.\d]+)", lines[0]["wkt"]):
            expect_near(float(x), float(re.search(r"\((\S+)", lines[0]["wkt"])[1]), 0.1, "straight")


def test_refused():
    """Degrees, oblong cells and another grid are refused; the proposed command mends the grid; polygons give the same lines"""
    with Folder() as f:
        to = region(f, 100)
        command(to, PYTHON, "valley.py", "100", "terrain.tif", "stands.tif", "road.geojson")
        config = (to / "config.yaml").read_text()
        command(to, "gdalwarp", "-q", "-t_srs", "EPSG:4326", "terrain.tif", "degrees.tif")
        command(to, "gdalwarp", "-q", "-tr", "5", "4", "terrain.tif", "oblong.tif")
        command(to, "gdalwarp", "-q", "-tr", "10", "10", "stands.tif", "coarse.tif")
        for name in ("degrees.tif", "oblong.tif"):
            said = command(to, PYTHON, "profiles.py", config.replace("terrain: terrain.tif", f"terrain: {name}"), status=1)
            expect_in(f"{name}: coordinates must be in metres, cells square", said)
            expect_in(f"gdalwarp -t_srs EPSG:25832 -tr 5 5 -r bilinear {name}", said)
        config = config.replace("stands: stands.tif", "stands: coarse.tif")
        said = command(to, PYTHON, "profiles.py", config, status=1)
        expect_in("coarse.tif: not on the grid of the terrain; try: gdalwarp", said)
        command(to, *said.split("try: ")[1].split())
        command(to, PYTHON, "profiles.py", config.replace("coarse.tif", "codes.tif"))
        raster = [(to / name).read_bytes() for name in ("lines.csv", "stretches.csv")]
        command(to, PYTHON, "-c", POLYGONS)
        command(to, PYTHON, "profiles.py", config.replace("coarse.tif", "polygons.gpkg"))
        expect_equal([(to / name).read_bytes() for name in ("lines.csv", "stretches.csv")], raster, "stands as polygons")
        said = command(to, PYTHON, "profiles.py", config.replace("coarse.tif", "codes.tif").replace("\n  3:", "\n  9:"), status=1)
        expect_in("codes.tif: a code is not in `codes` of config.yaml, which has [0, 1, 2, 9]", said)


def test_valley():
    """No verdict is lost, a failed line is a row, and a change computes only the jobs that depend on it"""
    with Folder() as f:
        to = region(f, 700 if FULL else 300)
        jobs = snakemake(to)
        pieces = sorted(path.stem for path in (to / "pieces").iterdir())
        expect(len(pieces) > 2, "pieces", pieces)
        after = ["all", "layers", "map", "page"]
        expect_equal(jobs, sorted(after + ["check", "profiles", "valley"] + [f"run{piece}" for piece in pieces]), "jobs")
        expect_complete(to)
        wanted = results(to)
        expect_equal(snakemake(to), [], "jobs without a change")

        lines = rows(to / "lines.csv")
        gone = next(line for line in lines if line["piece"] == pieces[1])
        (to / gone["slope.csv"]).unlink()
        expect_equal(snakemake(to), ["all", "check", "page", "profiles"], "jobs without a profile, which is made again")
        expect_equal(results(to), wanted, "results after a profile was missing")

        users = sorted(piece for piece in pieces if "mine.yaml" in (to / f"pieces/{piece}.csv").read_text())
        with open(to / "mine.yaml", "a", encoding="utf-8") as file:
            file.write("# touched\n")
        expect_equal(snakemake(to), sorted(after + [f"run{piece}" for piece in users]), "jobs of a changed stand")

        command(to, PYTHON, "-c", FELLED)
        before = {piece: (to / f"pieces/{piece}.csv").read_text() for piece in pieces}
        jobs = snakemake(to)
        changed = [piece for piece in pieces if (to / f"pieces/{piece}.csv").read_text() != before[piece]]
        expect(0 < len(changed) < len(pieces), "pieces of a felled corner", changed)
        expect_equal(jobs, sorted(after + ["check", "profiles"] + [f"run{piece}" for piece in changed]), "jobs of a felled corner")

        bad = next(line for line in lines if line["piece"] == pieces[0] and line["way"] == "steepest")
        change(to / bad["slope.csv"], ("\n5.00,", "\n5.00,x"))
        expect_equal(snakemake(to), sorted(after + [f"run{bad['piece']}"]), "jobs of a changed profile")
        expect_complete(to, [bad["id"]])


def test_killed():
    """A run that is killed with its jobs and run again gives the same bytes as a run in one go"""
    if not FULL:
        raise Skip("make check-all")
    with Folder() as f, Folder() as g:
        to, other = region(f, 700, 400), region(g, 700, 400)
        env = environment(HOME=str(to), USER="root")
        run = subprocess.Popen(["snakemake", "--cores", "2"], cwd=to, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               start_new_session=True)
        deadline = time.monotonic() + PATIENCE
        while not list(to.glob("rows/*.csv")) and time.monotonic() < deadline and run.poll() is None:
            time.sleep(0.05)
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        done, pieces = len(list(to.glob("rows/*.csv"))), len(list(to.glob("pieces/*.csv")))
        expect(0 < done < pieces, f"killed after {done} of {pieces} jobs")
        expect_in("--unlock", command(to, "snakemake", "--cores", "2", "--rerun-incomplete", status=1), "locked")
        snakemake(to, "--cores", "2", "--unlock")
        jobs = snakemake(to, "--cores", "2", "--rerun-incomplete")
        expect("valley" not in jobs and "profiles" not in jobs and sum(job.startswith("run") for job in jobs) < pieces, "jobs", jobs)
        snakemake(other)
        expect_equal(results(to), results(other), "bytes")


def test_slurm():
    """With --profile slurm each job is one of Slurm"""
    if not SLURM:
        raise Skip("tests/slurm.sh starts a Slurm")
    with Folder() as f, Folder() as g:
        to, other = region(f), region(g)
        snakemake(to, "--profile", "slurm")
        expect_complete(to)
        logs = [path.parent.name for path in to.glob(".snakemake/slurm_logs/*/*.log")]
        expect_equal(sorted(logs), sorted(["rule_check", "rule_page", "rule_profiles"] + ["rule_run"] * len(list(to.glob("rows/*.csv")))), "jobs")
        snakemake(other)
        expect_equal(results(to), results(other), "bytes")


run_all(__name__)
