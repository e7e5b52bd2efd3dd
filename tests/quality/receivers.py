# SPDX-License-Identifier: Apache-2.0
"""The poses of a KITTI sequence as receivers would have written them: OXTS packets, geodetic and local tables. All of one drive."""

import json
import math
import shutil
import struct

ORIGIN = (49.011212804408, 8.4228850437969, 112.83)  # of the body at the first frame
FRD_FROM_FLU = ((1, 0, 0), (0, -1, 0), (0, 0, -1))
ENU_FROM_NED = ((0, 1, 0), (1, 0, 0), (0, 0, -1))
AXES = {"frd": ((0, 0, 1), (1, 0, 0), (0, 1, 0)), "flu": ((0, 0, 1), (-1, 0, 0), (0, -1, 0))}  # from a camera that looks forward
SEMI_MAJOR, FLATTENING = 6378137.0, 1 / 298.257223563
SQUARED_ECCENTRICITY = FLATTENING * (2 - FLATTENING)


def multiply(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)) for i in range(3))


def transpose(a):
    return tuple(zip(*a))


def turned(a, v):
    return tuple(sum(a[i][k] * v[k] for k in range(3)) for i in range(3))


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def compose(a, b):
    """Of two poses (rotation, translation)."""
    return multiply(a[0], b[0]), plus(turned(a[0], b[1]), a[1])


def inverse(a):
    back = transpose(a[0])
    return back, tuple(-x for x in turned(back, a[1]))


def rotation_of(roll, pitch, yaw):
    """Rz(yaw) Ry(pitch) Rx(roll), radians."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(x), math.sin(x)) for x in (roll, pitch, yaw))
    return ((cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
            (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr), (-sp, cp * sr, cp * cr))


def angles_of(r):
    return math.atan2(r[2][1], r[2][2]), math.asin(max(-1.0, min(1.0, -r[2][0]))), math.atan2(r[1][0], r[0][0])


def quaternion_of(r):
    """x y z w."""
    w = math.sqrt(max(0.0, 1 + r[0][0] + r[1][1] + r[2][2])) / 2
    assert w > 0.1
    return (r[2][1] - r[1][2]) / (4 * w), (r[0][2] - r[2][0]) / (4 * w), (r[1][0] - r[0][1]) / (4 * w), w


def enu_axes(latitude, longitude):
    """Rows: east, north, up in earth-centred axes; degrees."""
    (sf, cf), (sl, cl) = ((math.sin(x), math.cos(x)) for x in (math.radians(latitude), math.radians(longitude)))
    return (-sl, cl, 0), (-sf * cl, -sf * sl, cf), (cf * cl, cf * sl, sf)


def earth_centred(latitude, longitude, height):
    up = enu_axes(latitude, longitude)[2]
    normal = SEMI_MAJOR / math.sqrt(1 - SQUARED_ECCENTRICITY * up[2] ** 2)
    return (normal + height) * up[0], (normal + height) * up[1], (normal * (1 - SQUARED_ECCENTRICITY) + height) * up[2]


def geodetic(x, y, z):
    """Degrees, degrees, metres; by iteration, to the last digits near the surface."""
    across = math.hypot(x, y)
    latitude = math.atan2(z, across * (1 - SQUARED_ECCENTRICITY))
    for _ in range(20):
        normal = SEMI_MAJOR / math.sqrt(1 - SQUARED_ECCENTRICITY * math.sin(latitude) ** 2)
        height = across * math.cos(latitude) + z * math.sin(latitude) - SEMI_MAJOR ** 2 / normal
        latitude = math.atan2(z, across * (1 - SQUARED_ECCENTRICITY * normal / (normal + height)))
    return math.degrees(latitude), math.degrees(math.atan2(y, x)), height


class Drive:
    """The drive of a KITTI sequence, whose world it puts on the earth: level, but for a slope, towards the south-west."""

    HEADING, PITCH, ROLL = (math.radians(x) for x in (237.9, 0.4, 1.3))
    LEVER_ARM = {"frd": (1.2, 0.3, -0.9), "flu": (1.2, -0.3, 0.9)}  # metres: the camera in the body's axes
    BORESIGHT = rotation_of(0.02, -0.015, 0.01)  # of the mounted camera against one that looks forward

    def __init__(self, sequence):
        self.times = [float(line) for line in (sequence / "times.txt").read_text().split()]
        rows = [[float(x) for x in line.split()] for line in (sequence / "poses.txt").read_text().splitlines()]
        given = [(tuple(tuple(row[4 * i:4 * i + 3]) for i in range(3)), tuple(row[3::4])) for row in rows]
        enu_from_body = multiply(ENU_FROM_NED, rotation_of(self.ROLL, self.PITCH, self.HEADING))
        body_from_camera = self.body_from_camera("frd")
        place = compose((enu_from_body, (0, 0, 0)), body_from_camera)  # of the first camera, whose pose is the unit
        to_first = inverse(self.orthogonal(given[0]))
        self.cameras = [compose(place, compose(to_first, self.orthogonal(pose))) for pose in given]  # in east, north, up
        self.bodies = [compose(camera, inverse(body_from_camera)) for camera in self.cameras]  # forward, right, down

    @staticmethod
    def orthogonal(pose):
        """The poses' files have nine digits: the nearest that angles state."""
        return rotation_of(*angles_of(pose[0])), pose[1]

    def body_from_camera(self, axes):
        in_frd = multiply(AXES["frd"], self.BORESIGHT)
        return (in_frd if axes == "frd" else multiply(FRD_FROM_FLU, in_frd)), self.LEVER_ARM[axes]

    def write_camera(self, path, calibration, axes):
        """camera.yaml of a rectified pair with `body`; `calibration`: width, height, fx, cx, cy, baseline."""
        width, height, focal, cx, cy, baseline = calibration
        rotation, arm = self.body_from_camera(axes)
        # the quaternion of a turn by 120 degrees has w = 1/2
        path.write_text(f"camera: {{model: pinhole, width: {width}, height: {height}, fx: {focal}, fy: {focal}, cx: {cx}, cy: {cy}}}\n"
                        f"right: {{baseline: {baseline}}}\n"
                        f"body: {{body_from_camera: {{translation: {list(arm)}, quaternion_xyzw: {list(quaternion_of(rotation))}}}}}\n")

    def places(self):
        """Of each body: latitude, longitude, height, and its rotation to east, north, up there."""
        axes, centre = enu_axes(*ORIGIN[:2]), earth_centred(*ORIGIN)
        for rotation, translation in self.bodies:
            latitude, longitude, height = geodetic(*plus(centre, turned(transpose(axes), translation)))
            yield latitude, longitude, height, multiply(enu_axes(latitude, longitude), multiply(transpose(axes), rotation))

    def write_table(self, path, geodetic_places, place_std=None, angle_std_deg=None):
        """`place_std`: east, north, up; `angle_std_deg`: roll, pitch, heading."""
        names = ["time_s", *(("latitude_deg", "longitude_deg", "height_m") if geodetic_places else ("east_m", "north_m", "up_m")),
                 "roll_deg", "pitch_deg", "heading_deg"]
        names += ["std_east_m", "std_north_m", "std_up_m"] if place_std else []
        names += ["std_roll_deg", "std_pitch_deg", "std_heading_deg"] if angle_std_deg else []
        places = list(self.places()) if geodetic_places else [(*body[1], body[0]) for body in self.bodies]
        lines = [",".join(names)]
        for time, (*place, rotation) in zip(self.times, places):
            angles = [math.degrees(x) for x in angles_of(multiply(ENU_FROM_NED, rotation))]
            numbers = [*place, *angles, *(place_std or ()), *(angle_std_deg or ())]
            lines.append(",".join([f"{time:.6f}", *(f"{x:.14g}" for x in numbers)]))
        path.write_text("\n".join(lines) + "\n")

    def write_oxts(self, folder, accuracy):
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "data").mkdir(parents=True)
        stamps = [f"1970-01-01 00:{int(time // 60):02}:{time % 60:09.6f}" for time in self.times]
        (folder / "timestamps.txt").write_text("\n".join(stamps) + "\n")
        for number, (*place, rotation) in enumerate(self.places()):
            values = [*place, *angles_of(multiply(rotation, FRD_FROM_FLU)), *([0.0] * 24)]
            values[23] = accuracy
            (folder / f"data/{number:010}.txt").write_text(" ".join(f"{x:.14g}" for x in values) + "\n")


def read_landmarks(folder):
    """Of a map: by what saw it (keyframe and feature of each sighting) the place and the covariance (9) of each landmark."""
    points = (folder / "Point.bin").read_bytes()
    count = struct.unpack_from("<I", points, 12)[0]
    rows = (folder / "Descriptor.bin").read_bytes()
    stride, = struct.unpack_from("<I", rows, 20)
    landmarks = {}
    for i in range(count):
        _, sightings, first, *numbers = struct.unpack_from("<IIQ3d9d", points, 24 + 112 * i)
        seen = tuple(struct.unpack_from("<ii", rows, 32 + stride * (first + k)) for k in range(sightings))
        landmarks[seen] = numbers[:3], numbers[3:]
    return landmarks


def map_origin(folder):
    origin = json.loads((folder / "map.json").read_text())["origin"]
    return origin["latitude_deg"], origin["longitude_deg"], origin["height_m"]
