"""Writes configs/logs/hummingbird_example.csv: a flight of the Hummingbird by equations of motion of its own, at 50 Hz.

usage: example_flight.py [FILE]    without a file, on standard output

An independent implementation of [FurrerBurriAchtelikSiegwart2016] sec. on rotor forces, with rotation matrices and Heun's
method. A proportional-derivative controller flies changing attitudes; the speeds of the rotors are constant over a row.
"""

import math
import sys

MASS, INERTIA, ARM, HEIGHT, G = 0.716, (0.007, 0.007, 0.012), 0.17, 0.01, 9.81
THRUST, TORQUE, DRAG, ROLLING, ROTOR_INERTIA = 8.54858e-6, 0.016, 8.06428e-5, 1e-6, 7.67e-6
HUBS = [(ARM, 0.0, -HEIGHT), (0.0, ARM, -HEIGHT), (-ARM, 0.0, -HEIGHT), (0.0, -ARM, -HEIGHT)]
CLOCKWISE = [1.0, -1.0, 1.0, -1.0]
ROW_S, STEPS = 0.02, 40
NAMES = ["t_s", "north_m", "east_m", "down_m", "roll_rad", "pitch_rad", "yaw_rad", "v_north_mps", "v_east_mps", "v_down_mps",
         "p_radps", "q_radps", "r_radps", "motor_0_radps", "motor_1_radps", "motor_2_radps", "motor_3_radps"]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rotation(roll, pitch, yaw):
    """The matrix from the body to the world, by rows."""
    cr, sr, cp, sp, cy, sy = (f(x) for x in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return ((cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy),
            (cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy), (-sp, sr * cp, cr * cp))


def rates(x, speeds):
    """The derivative of (p_W, roll, pitch, yaw, v_W, w_B)."""
    roll, pitch, yaw = x[3:6]
    w = x[9:12]
    R = rotation(roll, pitch, yaw)
    v = [sum(R[i][k] * x[6 + i] for i in range(3)) for k in range(3)]
    force, moment, spin = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0], 0.0
    for hub, turn, speed in zip(HUBS, CLOCKWISE, speeds):
        at_hub = [a + b for a, b in zip(v, cross(w, hub))]
        lift = THRUST * speed ** 2
        f = (-DRAG * speed * at_hub[0], -DRAG * speed * at_hub[1], -lift)
        m = cross(hub, f)
        force = [a + b for a, b in zip(force, f)]
        moment = [moment[0] + m[0] - ROLLING * speed * at_hub[0], moment[1] + m[1] - ROLLING * speed * at_hub[1],
                  moment[2] + m[2] - turn * TORQUE * lift]
        spin += turn * ROTOR_INERTIA * speed
    angular = [INERTIA[0] * w[0], INERTIA[1] * w[1], INERTIA[2] * w[2] + spin]
    gyroscopic = cross(w, angular)
    acceleration = [sum(R[i][k] * force[k] for k in range(3)) / MASS + (G if i == 2 else 0.0) for i in range(3)]
    turning = w[1] * math.sin(roll) + w[2] * math.cos(roll)
    euler = [w[0] + math.tan(pitch) * turning, w[1] * math.cos(roll) - w[2] * math.sin(roll), turning / math.cos(pitch)]
    return [*x[6:9], *euler, *acceleration, *((moment[k] - gyroscopic[k]) / INERTIA[k] for k in range(3))]


def controlled(x, t):
    """Rotor speeds for attitudes that change with several frequencies."""
    roll = 0.25 * math.sin(1.3 * t) + 0.10 * math.sin(5.1 * t)
    pitch = 0.25 * math.sin(0.9 * t + 1.0) + 0.10 * math.sin(4.3 * t)
    yaw = 0.5 * math.sin(0.7 * t)
    lift = MASS * (G + 1.5 * math.sin(2.1 * t) + 1.5 * x[8] + 1.0 * (x[2] + 10.0)) / (math.cos(x[3]) * math.cos(x[4]))
    torque = [INERTIA[k] * (gain * (goal - x[3 + k]) - 2.0 * math.sqrt(gain) * 0.7 * x[9 + k])
              for k, (gain, goal) in enumerate(((60.0, roll), (60.0, pitch), (8.0, yaw)))]
    each, yawing = lift / 4.0, torque[2] / (4.0 * TORQUE)
    lifts = [each + torque[1] / (2.0 * ARM) - yawing, each - torque[0] / (2.0 * ARM) + yawing,
             each - torque[1] / (2.0 * ARM) - yawing, each + torque[0] / (2.0 * ARM) + yawing]
    return [round(math.sqrt(max(lift, 0.05) / THRUST), 3) for lift in lifts]


def rows(count=500):
    x = [0.0, 0.0, -10.0, *[0.0] * 9]
    for row in range(count):
        t = row * ROW_S
        speeds = controlled(x, t)
        yield [round(t, 6), *x, *speeds]
        h = ROW_S / STEPS
        for _ in range(STEPS):
            k1 = rates(x, speeds)
            k2 = rates([a + h * b for a, b in zip(x, k1)], speeds)
            x = [a + 0.5 * h * (b + c) for a, b, c in zip(x, k1, k2)]


def main():
    lines = [",".join(NAMES)] + [",".join(f"{value:.7g}" for value in row) for row in rows()]
    text = "\n".join(lines) + "\n"
    if len(sys.argv) > 1:
        with open(sys.argv[1], "w") as file:
            file.write(text)
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
