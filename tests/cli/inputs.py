# SPDX-License-Identifier: Apache-2.0
"""Makes small inputs: images, sequences, trajectories. Each maker returns a function of a folder, for Case.given."""

import struct
import zlib

WIDTH, HEIGHT = 64, 48

CAMERA = """\
camera: {model: pinhole, width: 64, height: 48, fx: 50.0, fy: 50.0, cx: 31.5, cy: 23.5}
depth: {scale: 1000.0}
"""


def png_bytes(width=WIDTH, height=HEIGHT, kind="rgb8", value=100):
    """A PNG of a dim texture; kind: rgb8, gray8 or gray16."""
    depth, color, pack = {"rgb8": (8, 2, "BBB"), "gray8": (8, 0, "B"), "gray16": (16, 0, ">H")}[kind]
    def pixel(u, v):
        level = value + (u * 7 + v * 13) % 50
        return struct.pack(pack, *([level] * (3 if color else 1)))
    rows = b"".join(b"\0" + b"".join(pixel(u, v) for u in range(width)) for v in range(height))
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def file(name, contents):
    """A file, text or bytes."""
    def make(folder):
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(contents if isinstance(contents, bytes) else contents.encode())
    return make


def folder(name):
    return lambda root: (root / name).mkdir(parents=True)


def without(name):
    """Removes what an earlier maker made."""
    return lambda root: (root / name).unlink()


def replaced(name, old, new):
    """Changes a text file that an earlier maker made."""
    def make(root):
        text = (root / name).read_text()
        assert old in text, f"'{old}' is not in {name}"
        (root / name).write_text(text.replace(old, new, 1))
    return make


def tum_sequence(name="seq", frames=3):
    """RGB-D in TUM layout with camera.yaml and truth, one frame a tenth of a second."""
    stamps = [f"{1 + 0.1 * i:.6f}" for i in range(frames)]
    def make(root):
        color, depth = png_bytes(), png_bytes(kind="gray16", value=2000)
        for i, _ in enumerate(stamps):
            file(f"{name}/rgb/{i}.png", color)(root)
            file(f"{name}/depth/{i}.png", depth)(root)
        file(f"{name}/rgb.txt", "".join(f"{t} rgb/{i}.png\n" for i, t in enumerate(stamps)))(root)
        file(f"{name}/depth.txt", "".join(f"{t} depth/{i}.png\n" for i, t in enumerate(stamps)))(root)
        file(f"{name}/groundtruth.txt", trajectory_text(stamps))(root)
        file(f"{name}/camera.yaml", CAMERA)(root)
    return make


SENSOR = """\
%YAML:1.0
sensor_type: camera
T_BS:
  cols: 4
  data: [1.0, 0.0, 0.0, {x}, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
rate_hz: 20
resolution: [64, 48]
camera_model: pinhole
intrinsics: [50.0, 50.0, 31.5, 23.5] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.2, 0.05, 0.0001, 0.0002]
"""

RIGHT_CAMERA = """\
right:
  camera: {model: kb4, width: 64, height: 48, fx: 50.0, fy: 50.0, cx: 31.5, cy: 23.5, distortion: [0, 0, 0, 0]}
  left_from_right: {translation: [0.1, 0, 0], quaternion_xyzw: [0, 0, 0, 1]}
"""


def asl_sequence(name="seq", frames=3):
    """Raw stereo pairs in ASL layout with the truth of the body, 20 a second."""
    stamps = [1000000000 + 50000000 * i for i in range(frames)]
    def make(root):
        for camera, x in (("cam0", "0.0"), ("cam1", "0.1")):
            place = f"{name}/mav0/{camera}"
            for stamp in stamps:
                file(f"{place}/data/{stamp}.png", png_bytes(kind="gray8"))(root)
            file(f"{place}/data.csv", "#timestamp [ns],filename\n" + "".join(f"{t},{t}.png\n" for t in stamps))(root)
            file(f"{place}/sensor.yaml", SENSOR.replace("{x}", x))(root)
        truth = "".join(f"{t},{0.1 * i},0,0,1,0,0,0,0,0,0\n" for i, t in enumerate(stamps))
        file(f"{name}/mav0/state_groundtruth_estimate0/data.csv", "#timestamp,p,q,v\n" + truth)(root)
    return make


def kitti_sequence(name="seq", frames=2):
    """Raw stereo pairs in KITTI's folders, both cameras in camera.yaml, without truth."""
    def make(root):
        for camera in ("image_0", "image_1"):
            for i in range(frames):
                file(f"{name}/{camera}/{i:06}.png", png_bytes(kind="gray8"))(root)
        file(f"{name}/times.txt", "".join(f"{0.1 * i:.6f}\n" for i in range(frames)))(root)
        file(f"{name}/camera.yaml", CAMERA.splitlines()[0] + "\n" + RIGHT_CAMERA)(root)
    return make


def trajectory_text(stamps):
    """On a bend, so that it can be aligned."""
    return "".join(f"{t} {0.01 * i:.4f} {0.001 * i * i:.4f} 0 0 0 0 1\n" for i, t in enumerate(stamps))


def trajectory(name="poses.txt", count=3):
    return file(name, trajectory_text([f"{1 + 0.1 * i:.6f}" for i in range(count)]))
