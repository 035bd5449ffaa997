#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make an invented valley to try the workflow: valley.py LENGTH TERRAIN STANDS ROAD

A road runs along the foot of a slope with two bands of rock, gullies, a quarry (a pit) and a corner without data."""
import json
import sys

import numpy as np
from osgeo import gdal, osr

CELL, WIDTH, WEST, NORTH = 5, 700, 360000, 4860000


def write(path, array, kind, nodata):
    srs = osr.SpatialReference()
    srs.ImportFromEPSG(32633)
    out = gdal.GetDriverByName("GTiff").Create(path, array.shape[1], array.shape[0], 1, kind, ["COMPRESS=DEFLATE"])
    out.SetGeoTransform((WEST, CELL, 0, NORTH, 0, -CELL))
    out.SetProjection(srs.ExportToWkt())
    out.GetRasterBand(1).SetNoDataValue(nodata)
    out.GetRasterBand(1).WriteArray(array)


def road(x):
    return 540 + 30 * np.sin(x / 140)


def band(x, start, height, width):
    """Return the rise of a band of rock, north of `start` metres above the road."""
    return np.maximum(0, height) * np.clip((uphill - start - 12 * np.sin(x / 60)) / width, 0, 1)


length, terrain, stands, line = int(sys.argv[1]), *sys.argv[2:]
x, y = np.meshgrid(np.arange(length // CELL) * CELL + CELL / 2, np.arange(WIDTH // CELL) * CELL + CELL / 2)
uphill = road(x) - y
z = 300 + np.interp(uphill, [-200, -60, -8, 4, 14, 190, 430, 800], [90, -9, -1, 0, 3, 122, 270, 330])
z += band(x, 180, 55 * np.sin(x / 150 + .6), 25) + band(x, 320, 40 * np.cos(x / 210), 18)
z += np.clip(uphill / 60, 0, 1) * (3 * np.sin(x / 21 + y / 90) + .4 * np.sin(x / 4) * np.cos(y / 5))
z -= 60 * np.exp(-((x - .4 * length) ** 2 + (uphill - 120) ** 2) / 1500)
z[(x > length - 80) & (uphill > 250)] = -9999
code = np.select([uphill < 15, uphill < 130 + 50 * np.sin(x / 90), uphill < 320], [0, 1, 2], 3)
write(terrain, z, gdal.GDT_Float32, -9999)
write(stands, code, gdal.GDT_Byte, 255)
points = [[WEST + float(a), NORTH - round(float(road(a)), 2)] for a in range(10, length, 10)]
feature = {"type": "Feature", "properties": {"name": "SP 1"}, "geometry": {"type": "LineString", "coordinates": points}}
crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}
with open(line, "w", encoding="utf-8") as out:
    json.dump({"type": "FeatureCollection", "crs": crs, "features": [feature]}, out)
