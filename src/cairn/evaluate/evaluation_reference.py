# SPDX-License-Identifier: Apache-2.0
"""Reference values of evaluation_test.cpp: `python3 evaluation_reference.py`.

ATE and RPE as evo defines them and KITTI's drift, written a second time and another way: matrices as nested lists,
the rotation of the alignment from Horn's quaternion (1987) instead of Umeyama's SVD. Needs nothing but Python.
evaluation_evo.py asks evo itself.
"""
import math
import statistics


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(len(b))) for j in range(len(b[0]))] for i in range(len(a))]


def transpose(a):
    return [list(row) for row in zip(*a)]


def apply(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def rotation(w):
    """Rodrigues' formula with matrices."""
    angle = math.sqrt(sum(x * x for x in w))
    x, y, z = (c / angle for c in w)
    k = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    kk = multiply(k, k)
    return [[(i == j) + math.sin(angle) * k[i][j] + (1 - math.cos(angle)) * kk[i][j] for j in range(3)]
            for i in range(3)]


def angle_deg(r):
    """From sine and cosine, exact for small angles as well."""
    sine = 0.5 * math.sqrt((r[2][1] - r[1][2])**2 + (r[0][2] - r[2][0])**2 + (r[1][0] - r[0][1])**2)
    return math.degrees(math.atan2(sine, 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1)))


def reference_pose(i):
    return (rotation([0.1 * math.sin(i), 0.2 * math.cos(0.5 * i), 0.3 * i + 0.1]),
            [math.cos(0.3 * i), 1.5 * math.sin(0.3 * i), 0.1 * i + 0.05 * math.sin(i)])


def estimated_pose(i):
    r, t = reference_pose(i)
    turn = rotation([0, 0, 0.5])
    noise = [0.02 * math.sin(7 * i), 0.02 * math.cos(5 * i), 0.02 * math.sin(3 * i + 1)]
    moved = apply(turn, [t[k] + noise[k] for k in range(3)])
    wobble = rotation([0.01 * math.cos(3 * i), 0.01 * math.sin(2 * i), 0.01 * math.cos(i)])
    return (multiply(turn, multiply(r, wobble)), [0.8 * moved[k] + k + 1 for k in range(3)])


def wobble(i):
    return rotation([0.001 * math.sin(i), 0.002 * math.cos(2 * i), 0.001 * math.sin(3 * i)])


def true_drive(i):
    """A drive of 1.3 km, about 3 m a frame."""
    turn = rotation([0.01 * math.sin(0.7 * i), 0.02 * math.cos(0.3 * i), 0.8 * math.sin(0.02 * i) + 0.1])
    return turn, [3 * i + 20 * math.sin(0.05 * i), 40 * math.sin(0.03 * i), math.sin(0.01 * i)]


def estimated_drive(i):
    """1 % too long, slowly turning away."""
    r, t = true_drive(i)
    away = rotation([0.00001 * i, 0.00002 * i, 0.0001 * i + 0.001])
    place = apply(away, t)
    return (multiply(away, multiply(r, wobble(i))),
            [1.01 * place[k] + 0.05 * math.sin((k + 2) * i) for k in range(3)])


ROOM = ([reference_pose(i) for i in range(12)], [estimated_pose(i) for i in range(12)])
DRIVE = ([true_drive(i) for i in range(400)], [estimated_drive(i) for i in range(400)])


def largest_eigenvector(n):
    """Cyclic Jacobi over a symmetric 4x4 matrix."""
    v = [[float(i == j) for j in range(4)] for i in range(4)]
    for _ in range(100):
        for p in range(4):
            for q in range(p + 1, 4):
                if n[p][q] == 0:
                    continue
                theta = 0.5 * math.atan2(2 * n[p][q], n[q][q] - n[p][p])
                c, s = math.cos(theta), math.sin(theta)
                j = [[float(a == b) for b in range(4)] for a in range(4)]
                j[p][p], j[q][q], j[p][q], j[q][p] = c, c, s, -s
                n = multiply(transpose(j), multiply(n, j))
                v = multiply(v, j)
    best = max(range(4), key=lambda i: n[i][i])
    return [v[i][best] for i in range(4)]


def align(source, target, with_scale):
    """Horn 1987: rotation from the quaternion that maximises q^T N q, then scale and translation."""
    n = len(source)
    ms = [sum(p[k] for p in source) / n for k in range(3)]
    mt = [sum(p[k] for p in target) / n for k in range(3)]
    s = [[sum((p[a] - ms[a]) * (q[b] - mt[b]) for p, q in zip(source, target)) for b in range(3)]
         for a in range(3)]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = s
    w, x, y, z = largest_eigenvector([[xx + yy + zz, yz - zy, zx - xz, xy - yx],
                                      [yz - zy, xx - yy - zz, xy + yx, zx + xz],
                                      [zx - xz, xy + yx, yy - xx - zz, yz + zy],
                                      [xy - yx, zx + xz, yz + zy, zz - xx - yy]])
    r = [[w*w + x*x - y*y - z*z, 2 * (x*y - w*z), 2 * (x*z + w*y)],
         [2 * (x*y + w*z), w*w - x*x + y*y - z*z, 2 * (y*z - w*x)],
         [2 * (x*z - w*y), 2 * (y*z + w*x), w*w - x*x - y*y + z*z]]
    scale = 1.0
    if with_scale:
        over = sum((q[k] - mt[k]) * apply(r, [p[c] - ms[c] for c in range(3)])[k]
                   for p, q in zip(source, target) for k in range(3))
        scale = over / sum((p[k] - ms[k])**2 for p in source for k in range(3))
    rm = apply(r, ms)
    return scale, r, [mt[k] - scale * rm[k] for k in range(3)]


def show(name, errors):
    mean = sum(errors) / len(errors)
    values = [len(errors), math.sqrt(sum(e * e for e in errors) / len(errors)), mean,
              statistics.median(errors), statistics.pstdev(errors), min(errors), max(errors)]
    print(f'{name:12}', ', '.join(f'{v:.15g}' for v in values))


def relative(a, b):
    """a^-1 b"""
    rt = transpose(a[0])
    return multiply(rt, b[0]), apply(rt, [b[1][k] - a[1][k] for k in range(3)])


def aligned(mode, ref, est):
    if mode == 'none':
        return est
    scale, r, t = align([p[1] for p in est], [p[1] for p in ref], mode == 'sim3')
    print(f'scale {scale:.15g}')
    return [(multiply(r, p[0]), [scale * x + y for x, y in zip(apply(r, p[1]), t)]) for p in est]


def evaluate(mode, intervals_of, ref, est):
    est = aligned(mode, ref, est)
    show('ate_m', [math.dist(p[1], q[1]) for p, q in zip(est, ref)])
    show('ate_deg', [angle_deg(multiply(transpose(p[0]), q[0])) for p, q in zip(est, ref)])
    errors = [relative(relative(ref[i], ref[j]), relative(est[i], est[j])) for i, j in intervals_of(est)]
    show('rpe_m', [math.hypot(*e[1]) for e in errors])
    show('rpe_deg', [angle_deg(e[0]) for e in errors])


def by_frames(delta, all_pairs):
    if all_pairs:
        return lambda poses: [(i, i + delta) for i in range(len(poses)) if i + delta < len(poses)]
    return lambda poses: [(i, i + delta) for i in range(0, len(poses) - delta, delta)]


def path_of(poses):
    lengths = [0]
    for a, b in zip(poses, poses[1:]):
        lengths.append(lengths[-1] + math.dist(a[1], b[1]))
    return lengths


def by_path(delta, all_pairs):
    def intervals(poses):
        path = path_of(poses)
        if all_pairs:
            found = []
            for i in range(len(poses) - 1):
                off = {j: abs(path[j] - path[i] - delta) for j in range(i + 1, len(poses))}
                j = min(off, key=off.get)
                if off[j] <= 0.1 * delta:
                    found.append((i, j))
            return found
        marks, begun = [], 0
        for i, length in enumerate(path):
            if length - begun >= delta:
                marks.append(i)
                begun = length
        return list(zip(marks, marks[1:]))
    return intervals


def by_time(delta):
    """Stamps are 0.1 s apart."""
    def intervals(poses):
        nearest = [min(range(i + 1, len(poses)), key=lambda j: abs(0.1 * (j - i) - delta))
                   for i in range(len(poses) - 1)]
        return [(i, j) for i, j in enumerate(nearest) if j != len(poses) - 1]
    return intervals


def drift(ref, est):
    path, rows = path_of(ref), []
    for length in range(100, 900, 100):
        for i in range(0, len(ref), 10):
            j = next((j for j in range(i, len(ref)) if path[j] > path[i] + length), None)
            if j is not None:
                r, t = relative(relative(est[i], est[j]), relative(ref[i], ref[j]))
                rows.append((length, 100 * math.hypot(*t) / length, angle_deg(r) / length))
    for length in sorted({row[0] for row in rows}) + [None]:
        chosen = [row for row in rows if length in (None, row[0])]
        print(f'drift {length}', len(chosen), *(f'{sum(row[k] for row in chosen) / len(chosen):.15g}' for k in (1, 2)))


CASES = [('none', '1 frame', by_frames(1, False), ROOM),
         ('se3', '1 frame', by_frames(1, False), ROOM),
         ('se3', '3 frames', by_frames(3, False), ROOM),
         ('se3', '3 frames, all', by_frames(3, True), ROOM),
         ('sim3', '1 m', by_path(1.0, False), ROOM),
         ('sim3', '1 m, all', by_path(1.0, True), ROOM),
         ('se3', '0.3 s', by_time(0.3), ROOM),
         ('se3', '10 m, drive', by_path(10.0, False), DRIVE),
         ('sim3', '10 frames, drive', by_frames(10, True), DRIVE)]

if __name__ == '__main__':
    for mode, name, intervals_of, poses in CASES:
        print(f'--- {mode}, {name}')
        evaluate(mode, intervals_of, *poses)
    drift(DRIVE[0], aligned('se3', *DRIVE))
