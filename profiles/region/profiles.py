# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut lines of fall above roads: profiles.py "$(cat config.yaml)"

Writes lines.csv, stretches.csv, provenance.csv, pieces/*.csv (the lines of one job) and profiles/*.csv; pieces and profiles only if
they change. A point is (column, row) of a cell's centre, a way is a list of points, a stretch is named by its road and metre."""
import csv, hashlib, io, sys
from collections import Counter, defaultdict
from pathlib import Path
import numpy as np
import yaml
from osgeo import gdal, ogr, osr

def read_terrain(path):
    """Return heights (NaN: no data), their transform and coordinate system."""
    source = gdal.Open(path)
    t, srs, heights = source.GetGeoTransform(), osr.SpatialReference(source.GetProjection()), source.ReadAsArray().astype(float)
    if not srs.IsProjected() or srs.GetLinearUnits() != 1 or t[2] or t[4] or abs(t[1] + t[5]) > 1e-9 * t[1]:
        sys.exit(f"{path}: coordinates must be in metres, cells square and not rotated; try, with the EPSG number of your zone: "
                 f"gdalwarp -t_srs EPSG:25832 -tr 5 5 -r bilinear {path} metres.tif")
    return np.where(heights == source.GetRasterBand(1).GetNoDataValue(), np.nan, heights), t, srs

def read_codes(path):
    """Return the codes of a raster on the grid of the terrain, or of polygons."""
    source, (rows, columns), box = gdal.OpenEx(path), z.shape, (T[0], T[3] + z.shape[0] * T[5], T[0] + z.shape[1] * T[1], T[3])
    if source.RasterCount == 0:
        polygons = gdal.VectorTranslate("", source, format="Memory", dstSRS=f"EPSG:{EPSG}")
        source = gdal.Rasterize("", polygons, format="MEM", attribute="code", width=columns, height=rows, outputBounds=box)
    if (source.RasterYSize, source.RasterXSize) != z.shape or not np.allclose(source.GetGeoTransform(), T, 0, 1e-6):
        sys.exit(f"{path}: not on the grid of the terrain; try: gdalwarp -t_srs EPSG:{EPSG} -r near -ts {columns} {rows} "
                 f"-te {' '.join(map(str, box))} {path} codes.tif")
    return source.ReadAsArray().astype(int)

def read_roads(path):
    """Return the points of roads on the terrain, at most a quarter of a cell apart: column, row, number of the road, distance along it."""
    source, roads = gdal.VectorTranslate("", path, format="Memory", dstSRS=f"EPSG:{EPSG}"), []
    for feature in source.GetLayer(0):
        for line in ogr.ForceToMultiLineString(feature.GetGeometryRef().Clone()):
            line.Segmentize(CELL / 4)
            p = (np.array(line.GetPoints())[:, :2] - (T[0], T[3])) / (T[1], T[5]) - .5
            inside = ((p > 0) & (p < np.array(z.shape)[::-1] - 1)).all(axis=1)
            roads.append(np.column_stack([p, np.full(len(p), len(roads)), distances(p)])[inside])
    return np.concatenate(roads) if any(map(len, roads)) else sys.exit(f"{path}: no road lies on the terrain")

def distances(p):
    return CELL * np.append(0, np.cumsum(np.hypot(*np.diff(p, axis=0).T)))

def smooth(sigma):
    """Return the terrain smoothed by a Gaussian of `sigma` cells; cells without data have no weight."""
    n, sums = int(3 * sigma) + 1, [np.nan_to_num(z), (~np.isnan(z)).astype(float)]
    for axis in (0, 1):
        sums = [np.apply_along_axis(np.convolve, axis, a, np.exp(-.5 * (np.arange(-n, n + 1) / sigma) ** 2)) for a in sums]
    return np.where(np.isnan(z), np.nan, (sums[0] / np.maximum(sums[1], 1e-300))[n:-n, n:-n])

def sample(heights, p):
    """Return bilinear heights at points; NaN outside."""
    c, r = i = np.clip(np.floor(np.nan_to_num(p)).astype(int).T, 0, np.array(z.shape)[::-1, None] - 2)
    u, v = np.where((p.T < i) | (p.T > i + 1), np.nan, p.T - i)
    upper, lower = (heights[r + k, c] * (1 - u) + heights[r + k, c + 1] * u for k in (0, 1))
    return upper * (1 - v) + lower * v

def cells(p):
    """Return rows and columns of the nearest cells."""
    return tuple(np.clip(np.rint(p).astype(int).T, 0, np.array(z.shape)[::-1, None] - 1)[::-1])

def descend(low, start, keep=False):
    """Follow the steepest descent, a cell a step. Return the reasons of the ends, the points of the road and, if `keep`, the ways."""
    slope, p, going, ways = np.gradient(low)[::-1], start.astype(float), np.arange(len(start)), [[q] for q in start if keep]
    reason, hit = np.full(len(start), "too-long", object), np.full(len(start), -1)
    for _ in range(LIMIT):
        hit[going] = near[cells(p[going])]
        reason[going[hit[going] >= 0]] = "ok"
        going = going[hit[going] < 0]
        g = np.column_stack([sample(s, p[going]) for s in slope])
        q = p[going] - g / np.maximum(np.hypot(*g.T), 1e-12)[:, None]
        fall = sample(low, p[going]) - sample(low, q)
        reason[going[np.isnan(fall)]], reason[going[fall <= 0]] = "edge", "pit"
        going, q = going[fall > 0], q[fall > 0]
        p[going] = q
        for i in going if keep else ():
            ways[i].append(p[i].copy())
    return reason, hit, ways

def across(low, road):
    """Return the way straight down to the middle of a stretch, from the farthest face below the ridge; None: no face."""
    best = [-np.inf, None]
    for normal in ((road[0] - road[-1])[::-1] * (1, -1), (road[0] - road[-1])[::-1] * (-1, 1)):
        ray = road[len(road) // 2] + np.arange(LIMIT)[:, None] * normal / np.hypot(*normal)
        h = sample(low, ray)
        ridge = np.append(np.flatnonzero(~(h >= np.fmax.accumulate(h) - 5)), LIMIT)[0]
        tops = np.flatnonzero(face[cells(ray[:ridge])])
        if tops.size and tops[-1] > 0:
            best = max(best, [h[tops[-1]], ray[tops[-1]:0:-1]], key=lambda found: found[0])
    return best[1]

def belts(words, x, key):
    """Return the runs of equal words along x as YAML."""
    first = [i for i in range(len(x)) if i == 0 or words[i] != words[i - 1]]
    ends = [f"{x[i]:.2f}" for i in first[1:]] + ["end"]
    return "[" + ", ".join(f"{{from_m: {x[i]:.2f}, to_m: {e}, {key}: {words[i]}}}" for i, e in zip(first, ends) if words[i] != "none") + "]"

def write(path, table, always=False):
    text, path = io.StringIO(), Path(path)
    csv.writer(text, lineterminator="\n").writerows(table)
    if always or not path.exists() or path.read_text() != text.getvalue():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text.getvalue())

def wkt(p):
    return "LINESTRING (" + ",".join(f"{T[0] + (a + .5) * CELL:.1f} {T[3] - (b + .5) * CELL:.1f}" for a, b in p) + ")"

def add_line(stretch, way, part, m2, lowest, p):
    """Add the line along p, which ends beside the road: to the road, then straight on. Rocks start in each cell of a face that is
    not below `lowest`."""
    i, after, line = near[cells(p[-1:])][0], int(C["beyond_m"] / CELL), f"{stretch}-{way}-{part}"
    beside = roads[max(0, i - 12):i + 13, :2]
    p = np.vstack([p, beside[np.argmin(np.hypot(*(beside - p[-1]).T))]])
    ahead = p[-1] - p[max(-4, -len(p))]
    p = np.vstack([p, p[-1] + ahead / np.hypot(*ahead) * np.arange(1, after + 1)[:, None]])
    x, h, road_m = distances(p), sample(z, p), distances(p)[-1 - after]
    p, x, h = (a[:np.append(np.flatnonzero(np.isnan(h)), len(p))[0]] for a in (p, x, h))
    write(f"profiles/{line}.csv", [("distance", "elevation"), *((f"{a:.2f}", f"{b:.2f}") for a, b in zip(x, h))])
    starts = [a for a, b, rock in zip(x, h, face[cells(p)]) if rock and b > lowest - .01 and a < road_m]
    release = ", ".join(f"{{x_m: {a:.2f}, vx_m_s: {C['speed_m_s']}, share: {1 / len(starts):.6f}}}" for a in starts)
    ground = [grounds[k] for k in np.where(face[cells(p)], -1, codes[cells(p)])]
    lines.append([wkt(p), line, stretch, way, part, f"{m2:.0f}", f"{stretch.split('-')[0]}-{number[points[stretch][0]] // C['job']:04d}",
                  f"profiles/{line}.csv", f"{m2 / 1e4 * C['per_hectare_year']:.6g}", f"{road_m:.2f}", f"[{release}]",
                  *(belts([g[k] for g in ground], x, "stand" if k else "material") for k in range(len(C["options"]) + 1))])

gdal.UseExceptions()
C = yaml.safe_load(sys.argv[1])
z, T, SRS = read_terrain(C["terrain"])
CELL, EPSG, LIMIT = T[1], SRS.GetAuthorityCode(None), int(C["longest_m"] / T[1])
codes, grounds = read_codes(C["stands"]), {-1: ["cliff"] + ["none"] * len(C["options"]), **{int(k): v for k, v in C["codes"].items()}}
if set(codes[~np.isnan(z)].tolist()) - set(grounds):
    sys.exit(f"{C['stands']}: a code is not in `codes` of config.yaml, which has {sorted(grounds)[1:]}; add its ground and stands")
slope = np.hypot(*np.gradient(z, CELL))
face = (read_codes(C["faces"]) > 0 if C["faces"] else slope >= np.tan(np.radians(C["face_deg"]))) & ~np.isnan(slope)
start, top, area = np.argwhere(face)[:, ::-1], z[face], CELL ** 2 * np.hypot(1, slope[face])
roads, near, points, lines = read_roads(C["road"]), np.full(z.shape, -1), defaultdict(list), []
number = (roads[:, 3] // C["stretch_m"]).astype(int)
_, same, count = np.unique(np.column_stack([roads[:, 2], number]), axis=0, return_inverse=True, return_counts=True)
roads, number = roads[count[same] > 1], number[count[same] > 1]  # an end of one point is no stretch
stretch_of = [f"{road:.0f}-{n * C['stretch_m']:05.0f}" for road, n in zip(roads[:, 2], number)]
for i, stretch in enumerate(stretch_of):
    points[stretch].append(i)
for beside in ((1, 1), (1, -1), (-1, 1), (-1, -1), (0, 1), (1, 0), (0, -1), (-1, 0), (0, 0)):
    near[cells(roads[:, :2] + beside)] = np.arange(len(roads))
for way in ("smoother", "steepest"):
    low = smooth(C[way + "_m"] / CELL)
    reason, hit, _ = descend(low, start)
    below, chosen = defaultdict(list), []
    for i in np.flatnonzero(hit >= 0):
        below[stretch_of[hit[i]]].append(i)
    for stretch, k in below.items():
        k, foot = np.array(k), z[cells(roads[points[stretch][:1], :2])][0]
        lowest, middle, highest = top[k].min(), (top[k].min() + top[k].max()) / 2, top[k].max()
        split = lowest - foot < 2 / 3 * (highest - foot)
        for part, m in (("high", k[top[k] >= middle]), ("low", k[top[k] < middle])) if split else [("high", k)]:
            chosen.append((stretch, way, part, area[m].sum(), top[m].min(), m[np.argmax(top[m])]))
    for line, p in zip(chosen, descend(low, start[[line[-1] for line in chosen]], True)[2]):
        add_line(*line[:-1], np.array(p))
ends, stretches = np.full(z.shape, "", object), [["wkt", "stretch", "reason", "face_m2"]]
ends[face] = reason
for stretch, k in points.items():
    p, m2 = across(low, roads[k, :2]), area[below.get(stretch, [])].sum()
    why = "ok" if m2 else "no-face" if p is None else ends[cells(p[:1])][0].replace("ok", "drains-elsewhere")
    if p is not None and m2:
        add_line(stretch, "across", "high", m2, -np.inf, p)
    stretches.append([wkt(roads[k[0]:k[-1] + 2, :2]), stretch, why, f"{m2:.0f}"])
head = ["wkt", "id", "stretch", "way", "part", "face_m2", "piece", "slope.csv", "blocks.per_year", "controls[0].x_m",
        "release", "slope.materials", *(f"options[{k}].forest" for k in range(len(C["options"])))]
lines.sort(key=lambda line: line[1])
for piece in {line[6] for line in lines}:
    write(f"pieces/{piece}.csv", [head, *(line for line in lines if line[6] == piece)])
write("lines.csv", [head, *lines], True)
write("stretches.csv", stretches, True)
columns = [(k, hashlib.sha256(Path(C[k]).read_bytes()).hexdigest()[:16]) for k in ("terrain", "stands", "faces", "road", "scene") if C[k]]
columns += [("epsg", EPSG), ("cell_m", CELL)] + [(k, C[k]) for k in ("steepest_m", "smoother_m", "face_deg", "stretch_m", "per_hectare_year")]
for what, found in (("cells", reason), ("stretches", [s[2] for s in stretches[1:]])):
    columns += [(f"{what}_{word}".replace("-", "_"), n) for word, n in sorted(Counter(found).items())]
write("provenance.csv", zip(*columns), True)
