# SPDX-License-Identifier: GPL-3.0-or-later
"""Make an invented valley: valley.py LENGTH TERRAIN STANDS ROAD. It has bands of rock, gullies, a quarry and a corner without data."""
import json
import sys
import numpy as np
from osgeo import gdal

def write(path, array, kind, nodata):
    out = gdal.GetDriverByName("GTiff").Create(path, array.shape[1], array.shape[0], 1, kind, ["COMPRESS=DEFLATE"])
    out.SetGeoTransform((360000, 5, 0, 4860000, 0, -5))
    out.SetProjection("EPSG:32633")
    out.GetRasterBand(1).SetNoDataValue(nodata)
    out.GetRasterBand(1).WriteArray(array)

length, terrain, stands, road = int(sys.argv[1]), *sys.argv[2:]
x, y = np.meshgrid(np.arange(2.5, length, 5), np.arange(2.5, 700, 5))
up = 540 + 30 * np.sin(x / 140) - y  # metres north of the road
z = 300 + np.interp(up, [-200, -60, -8, 4, 14, 190, 430, 800], [90, -9, -1, 0, 3, 122, 270, 330])
for start, height, width in ((180, 55 * np.sin(x / 150 + .6), 25), (320, 40 * np.cos(x / 210), 18)):
    z += np.maximum(0, height) * np.clip((up - start - 12 * np.sin(x / 60)) / width, 0, 1)
z += np.clip(up / 60, 0, 1) * (3 * np.sin(x / 21 + y / 90) + .4 * np.sin(x / 4) * np.cos(y / 5))
z -= 50 * np.exp(-((x - .4 * length) ** 2 + (up - 120) ** 2) / 900)
z[(x > length - 80) & (up > 250)] = -9999
write(terrain, z, gdal.GDT_Float32, -9999)
write(stands, np.select([up < 15, up < 130 + 50 * np.sin(x / 90), up < 320], [0, 1, 2], 3), gdal.GDT_Byte, 255)
line = {"type": "LineString", "coordinates": [[360000 + a, 4859460 - round(30 * np.sin(a / 140), 2)] for a in range(10, length, 10)]}
json.dump({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}},
           "features": [{"type": "Feature", "properties": {}, "geometry": line}]}, open(road, "w"))
