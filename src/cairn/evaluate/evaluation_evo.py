# SPDX-License-Identifier: Apache-2.0
"""What evo says of the trajectories of evaluation_reference.py: `pip install evo; python3 evaluation_evo.py`.

The rows are those of evaluation_reference.py, to compare line by line.
"""
import numpy as np
from evo.core import metrics
from evo.core.trajectory import PosePath3D

import evaluation_reference as reference


def path_of(poses):
    matrices = []
    for r, t in poses:
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = r, t
        matrices.append(matrix)
    return PosePath3D(poses_se3=matrices)


def show(name, metric, ref, est):
    metric.process_data((ref, est))
    figures = metric.get_all_statistics()
    names = ('rmse', 'mean', 'median', 'std', 'min', 'max')
    print(f'{name:12}', ', '.join([str(len(metric.error))] + [f'{figures[n]:.15g}' for n in names]))


def evaluate(mode, delta, unit, all_pairs, poses):
    ref, est = path_of(poses[0]), path_of(poses[1])
    if mode != 'none':
        _, _, scale = est.align(ref, correct_scale=mode == 'sim3')
        print(f'scale {scale:.15g}')
    relations = (('m', metrics.PoseRelation.translation_part), ('deg', metrics.PoseRelation.rotation_angle_deg))
    for name, relation in relations:
        show(f'ate_{name}', metrics.APE(relation), ref, est)
    for name, relation in relations:
        show(f'rpe_{name}', metrics.RPE(relation, delta, unit, all_pairs=all_pairs), ref, est)


FRAMES, METRES = metrics.Unit.frames, metrics.Unit.meters
for case in [('none', 1, FRAMES, False, reference.ROOM),
             ('se3', 1, FRAMES, False, reference.ROOM),
             ('se3', 3, FRAMES, False, reference.ROOM),
             ('se3', 3, FRAMES, True, reference.ROOM),
             ('sim3', 1.0, METRES, False, reference.ROOM),
             ('sim3', 1.0, METRES, True, reference.ROOM),
             ('se3', 10.0, METRES, False, reference.DRIVE),
             ('sim3', 10, FRAMES, True, reference.DRIVE)]:
    print('---', case[0], case[1], case[2].value, 'all' if case[3] else '')
    evaluate(*case)
