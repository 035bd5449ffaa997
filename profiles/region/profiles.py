#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut lines of fall above a road: profiles.py CONFIG. Writes lines.csv and stretches.csv, pieces/*.csv (lines of one job) and
profiles/*.csv. A file of pieces or profiles whose content would not change is left alone, so that its job is not run again."""
import csv
import io
import sys
from pathlib import Path

import numpy as np
import yaml
from osgeo import gdal, ogr, osr

gdal.UseExceptions()
DOWN, PIT, EDGE, LONG = "ok", "pit", "no data or edge", "too long"


def fail(path, problem, remedy):
    sys.exit(f"{path}: {problem}; {remedy}")


def read_terrain(path):
    """Return heights (NaN: no data), the transform and the coordinate system."""
    source = gdal.Open(path)
    t, srs = source.GetGeoTransform(), osr.SpatialReference(source.GetProjection())
    warp = f"gdalwarp -t_srs EPSG:32633 -tr 5 5 -r bilinear {path} metres.tif (EPSG:32633 is an example: take yours)"
    if not source.GetProjection() or srs.IsGeographic() or srs.GetLinearUnits() != 1:
        fail(path, "coordinates are not in metres", warp)
    if t[2] or t[4] or abs(t[1] + t[5]) > 1e-9 * t[1]:
        fail(path, "cells are rotated or not square", warp)
    z = source.ReadAsArray().astype(float)
    nodata = source.GetRasterBand(1).GetNoDataValue()
    return np.where(z == nodata, np.nan, z), t, srs


def read_codes(path, shape, t, srs):
    """Return the codes of a raster on the grid of the terrain, or of polygons."""
    source = gdal.OpenEx(path)
    if source.RasterCount:
        if (source.RasterYSize, source.RasterXSize) != shape or not np.allclose(source.GetGeoTransform(), t, 0, 1e-6):
            corners = f"{t[0]} {t[3] + shape[0] * t[5]} {t[0] + shape[1] * t[1]} {t[3]}"
            fail(path, "is not on the grid of the terrain", f"gdalwarp -t_srs EPSG:{srs.GetAuthorityCode(None)} -te {corners} "
                 f"-ts {shape[1]} {shape[0]} -r near {path} codes.tif")
        return source.ReadAsArray().astype(int)
    target = gdal.GetDriverByName("MEM").Create("", shape[1], shape[0], 1, gdal.GDT_Int32)
    target.SetGeoTransform(t)
    target.SetProjection(srs.ExportToWkt())
    gdal.RasterizeLayer(target, [1], source.GetLayer(0), options=["ATTRIBUTE=code"])
    return target.ReadAsArray()


def smooth(z, sigma):
    """Return the terrain smoothed by a Gaussian of `sigma` cells; cells without data have no weight."""
    n = int(3 * sigma) + 1
    weight = np.exp(-.5 * (np.arange(-n, n + 1) / sigma) ** 2)
    total, weights = np.nan_to_num(z), (~np.isnan(z)).astype(float)
    for axis in (0, 1):
        total, weights = (np.apply_along_axis(np.convolve, axis, a, weight, "full") for a in (total, weights))
    inner = np.s_[n:n + z.shape[0], n:n + z.shape[1]]
    return np.where(np.isnan(z), np.nan, total[inner] / np.maximum(weights[inner], 1e-300))


def sample(z, p):
    """Return bilinear heights at points (column, row of cell centres); NaN outside."""
    i = np.clip(np.floor(p).astype(int), 0, np.array(z.shape[::-1]) - 2)
    f, (c, r) = p - i, i.T
    f[(f < 0) | (f > 1)] = np.nan
    u, v = f.T
    return (z[r, c] * (1 - u) + z[r, c + 1] * u) * (1 - v) + (z[r + 1, c] * (1 - u) + z[r + 1, c + 1] * u) * v


def read_roads(path, t, srs):
    """Return points every quarter of a cell, with the number of their road and their distance along it."""
    source = ogr.Open(path)
    layer = source.GetLayer(0)
    if layer.GetSpatialRef() and not layer.GetSpatialRef().IsSame(srs):
        fail(path, "has other coordinates than the terrain", f"ogr2ogr -t_srs EPSG:{srs.GetAuthorityCode(None)} metres.gpkg {path}")
    parts = []
    for feature in layer:
        g = feature.GetGeometryRef()
        for line in [g] if g.GetGeometryCount() == 0 else [g.GetGeometryRef(i) for i in range(g.GetGeometryCount())]:
            xy = np.array(line.GetPoints())[:, :2]
            along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(xy, axis=0).T))])
            s = np.arange(0, along[-1], t[1] / 4)
            points = [(np.interp(s, along, xy[:, k]) - t[3 * k]) / t[1 + 4 * k] - .5 for k in (0, 1)]
            parts.append(np.column_stack([*points, np.full(s.size, len(parts)), s]))
    return np.concatenate(parts)


def cells_of(p, shape):
    """Return rows and columns of the nearest cells."""
    return tuple(np.clip(np.rint(p).astype(int).T[::-1], 0, np.array(shape)[:, None] - 1))


def mark_roads(roads, shape):
    """Return the number of a point of the road for its cells and their neighbours, -1 elsewhere."""
    near = np.full(shape, -1)
    for dr, dc in sorted(((r, c) for r in (-1, 0, 1) for c in (-1, 0, 1)), key=lambda d: -abs(d[0]) - abs(d[1])):
        near[cells_of(roads[:, :2] + (dc, dr), shape)] = np.arange(len(roads))
    return near


def nearest(roads, i, p):
    """Return the point of the road nearest to p, among those beside point i."""
    k = np.arange(max(0, i - 12), min(len(roads), i + 13))
    return k[np.argmin(np.hypot(*(roads[k, :2] - p).T) + 1e9 * (roads[k, 2] != roads[i, 2]))]


def descend(z, near, start, steps, keep=False):
    """Follow the steepest descent from each start, a cell a step. Return the reason of its end, the point of the road (-1: none)
    and, if `keep`, the ways."""
    gy, gx = np.gradient(z)
    p, going, ways = start.astype(float), np.arange(len(start)), [[tuple(q)] for q in start] if keep else None
    reason, hit = np.full(len(start), LONG, object), np.full(len(start), -1)
    for _ in range(steps):
        hit[going] = near[cells_of(p[going], z.shape)]
        reason[going[hit[going] >= 0]] = DOWN
        going = going[hit[going] < 0]
        if not going.size:
            break
        g = np.column_stack([sample(gx, p[going]), sample(gy, p[going])])
        q = p[going] - g / np.maximum(np.hypot(*g.T), 1e-12)[:, None]
        before, after = sample(z, p[going]), sample(z, q)
        reason[going[np.isnan(after)]] = EDGE
        reason[going[after >= before]] = PIT
        q, going = q[after < before], going[after < before]
        p[going] = q
        for i in going if keep else ():
            ways[i].append(tuple(p[i]))
    return reason, hit, ways


def across(z, face, roads, i, steps):
    """Return the way straight down to point i of the road, from the farthest face below the ridge; None: no face."""
    a, b = roads[max(0, i - 12), :2], roads[min(len(roads) - 1, i + 12), :2]
    best = None
    for side in (1, -1):
        normal = side * np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(b - a))
        ray = roads[i, :2] + np.arange(steps)[:, None] * normal
        h = sample(z, ray)
        end = np.append(np.flatnonzero(~(h >= np.fmax.accumulate(h) - 5)), steps)[0]
        tops = np.flatnonzero(face[cells_of(ray[:end], z.shape)])
        if tops.size and (best is None or h[tops[-1]] > best[0]):
            best = h[tops[-1]], [tuple(q) for q in ray[tops[-1]:0:-1]]
    return best and best[1]


def runs(values, x):
    """Return (value, from, to) of each run of equal values along x; the last ends at the end."""
    first = [0] + [i for i in range(1, len(values)) if values[i] != values[i - 1]]
    ends = [f"{x[i]:.2f}" for i in first[1:]] + ["end"]
    return [(values[i], f"{x[i]:.2f}", end) for i, end in zip(first, ends)]


def write(path, rows):
    """Write a table unless the file has it already."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    path = Path(path)
    if not path.exists() or path.read_text() != text.getvalue():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text.getvalue())


def main():
    c = yaml.safe_load(Path(sys.argv[1]).read_text())
    z, t, srs = read_terrain(c["terrain"])
    cell, limit = t[1], int(c["longest_m"] / t[1])
    codes = read_codes(c["stands"], z.shape, t, srs)
    unknown = sorted(set(np.unique(codes[~np.isnan(z)])) - set(c["codes"]))
    if unknown:
        fail(c["stands"], f"has the codes {unknown}", "add them to `codes` of " + sys.argv[1])
    slope = np.hypot(*np.gradient(z, cell))
    face = read_codes(c["faces"], z.shape, t, srs) > 0 if c["faces"] else slope >= np.tan(np.radians(c["face_deg"]))
    face &= ~np.isnan(slope)
    start = np.argwhere(face)[:, ::-1]
    top, area = z[face], cell ** 2 * np.hypot(1, slope[face])
    roads = read_roads(c["road"], t, srs)
    near = mark_roads(roads, z.shape)
    piece = (roads[:, 3] // c["stretch_m"]).astype(int)
    stretches = {}  # (road, number): points of the road
    for i, key in enumerate(zip(roads[:, 2].astype(int), piece)):
        stretches.setdefault(key, []).append(i)

    def place(p):
        return f"{t[0] + (p[0] + .5) * cell:.1f} {t[3] - (p[1] + .5) * cell:.1f}"

    lines, drained, reasons = [], {}, {}

    def add(key, way, which, points, m2):
        """Add the line along `points`, which ends at the road, and its profile."""
        p = np.array(points)
        i = nearest(roads, stretches[key][len(stretches[key]) // 2] if way == "across" else int(near[cells_of(p[-1:], z.shape)][0]), p[-1])
        p = np.vstack([p, roads[i, :2]]) if np.hypot(*(roads[i, :2] - p[-1])) > .05 else p
        ahead = (p[-1] - p[max(0, len(p) - 4)]) / max(1e-9, np.hypot(*(p[-1] - p[max(0, len(p) - 4)])))
        after = p[-1] + ahead * np.arange(1, c["beyond_m"] / cell + 1)[:, None]
        road = len(p) - 1
        p = np.vstack([p, after])
        h, x = sample(z, p), cell * np.concatenate([[0], np.cumsum(np.hypot(*np.diff(p, axis=0).T))])
        end = np.append(np.flatnonzero(np.isnan(h)), len(p))[0]
        if end <= road + 1 or road < 1:
            return False
        p, h, x = p[:end], h[:end], x[:end]
        name = f"{key[0]}-{key[1] * c['stretch_m']:05.0f}-{way}-{which}"
        write(f"profiles/{name}.csv", [["distance", "elevation"], *([f"{a:.2f}", f"{b:.2f}"] for a, b in zip(x, h))])
        at = cells_of(p, z.shape)
        ground = np.where(face[at], -1, codes[at])
        rows = {-1: ["cliff"] + ["none"] * len(c["options"]), **c["codes"]}
        belts = ["[" + ", ".join(f"{{from_m: {a}, to_m: {b}, {word}: {v}}}" for v, a, b in runs([rows[g][k] for g in ground], x) if v != "none")
                 + "]" for k, word in enumerate(["material"] + ["stand"] * len(c["options"]))]
        lines.append((key, [f"LINESTRING ({','.join(map(place, p))})", name, f"{key[0]}-{key[1] * c['stretch_m']:05.0f}", way, which,
                            f"{m2:.0f}", f"profiles/{name}.csv", *belts, f"{m2 / 1e4 * c['per_hectare_year']:.6g}", f"{x[road]:.2f}"]))
        return True

    for way, metres in (("steepest", c["smoothing_m"]), ("smoother", c["smoother_m"])):
        low = smooth(z, metres / cell)
        why, hit, _ = descend(low, near, start, limit)
        groups = {}
        for i in np.flatnonzero(hit >= 0):
            groups.setdefault((int(roads[hit[i], 2]), int(piece[hit[i]])), []).append(i)
        chosen = []
        for key, cells in sorted(groups.items()):
            cells = np.array(cells)
            foot = z[cells_of(roads[stretches[key][:1], :2], z.shape)][0]
            ends = [cells[np.argmax(top[cells])], cells[np.argmin(top[cells])]]
            if top[ends[1]] - foot >= 2 / 3 * (top[ends[0]] - foot):
                ends = ends[:1]
            owner = np.argmin(np.abs(top[cells][:, None] - top[ends]), axis=1)
            chosen += [(key, name, e, area[cells[owner == k]].sum()) for k, (e, name) in enumerate(zip(ends, ("high", "low")))]
            if way == "steepest":
                drained[key] = area[cells].sum()
        _, _, ways = descend(low, near, start[[e for _, _, e, _ in chosen]], limit, True)
        for (key, name, _, m2), points in zip(chosen, ways):
            add(key, way, name, points, m2)
        if way == "steepest":
            main_low = low
            of_cell = np.full(z.shape, "", object)
            of_cell[face] = why
            counts = {r: (int((why == r).sum()), area[why == r].sum()) for r in (DOWN, PIT, EDGE, LONG)}
    judged = {key for key, _ in lines}
    for key in sorted(stretches):
        points = across(main_low, face, roads, stretches[key][len(stretches[key]) // 2], limit)
        reasons[key] = "ok" if key in drained else "no face"
        if points:
            if key in drained:
                add(key, "across", "high", points, drained[key])
            else:
                w = of_cell[cells_of(np.array(points[:1]), z.shape)][0]
                reasons[key] = "drains elsewhere" if w == DOWN else w
    print(counts, len(lines), {r: list(reasons.values()).count(r) for r in set(reasons.values())})
    head = ["wkt", "id", "stretch", "way", "part", "face_m2", "slope.csv", "slope.materials",
            *(f"options[{k}].forest" for k in range(len(c["options"]))), "blocks.per_year", "controls[0].x_m"]
    rows = [r for _, r in sorted(lines, key=lambda l: (l[0], l[1][1]))]
    Path("lines.csv").unlink(missing_ok=True)
    write("lines.csv", [head, *rows])


main()
