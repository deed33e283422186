"""Compares vectors with plain time stepping in doubles: small equal steps, no event is located.

It shares nothing with the simulator but the form of a machine. Its error is of the order of the step (2e-4), times what
the events amplify: it shows a wrong force, sign or rule, not a wrong digit. `python stepping.py 5 vectors/*.json` steps
the first five machines of each file up to the time UNTIL and compares the coordinates at the recorded states.
"""

import json
import math
import sys

import numpy as np

STEP, UNTIL, ALLOWED = 2e-4, 8, 1e-2


class Stepper:
    def __init__(self, machine, start):
        n = self.n = len(machine["coordinates"])
        self.machine, self.phase = machine, start.get("phase", 0)
        self.inverse = np.linalg.inv(self.matrix("mass"))
        self.damping, self.stiffness = self.matrix("damping"), self.matrix("stiffness")
        self.constant = np.array(machine.get("constant", [0] * n), float)
        self.q, self.v, self.t = np.array(start["q"], float), np.array(start["qdot"], float), 0.0
        self.stops, self.joints = machine.get("stop", []), machine.get("friction", [])
        for x in self.stops + self.joints:
            x["w"] = np.array(x["direction"], float)
        for s in self.stops:
            gap, rate = self.gap(s)
            force = self.contact_force(s, gap, rate)
            s["closed"] = gap < 0 and (s.get("opening") == "position" or force > 0)
            s["surface"] = -gap if gap < 0 and not s["closed"] else 0.0
        for j in self.joints:
            j["holds"] = abs(j["w"] @ self.v - j.get("belt", 0)) < 1e-12

    def matrix(self, key):
        a = np.array(self.machine.get(key, [0] * self.n), float)
        return np.diag(a) if a.ndim == 1 else a

    def theta(self, order):
        return order * (self.machine.get("frequency", 0) * self.t + self.phase)

    def gap(self, s):
        at = rate = 0.0
        for m in s.get("motion", []):
            c, d, w = (
                math.cos(self.theta(m["order"])),
                math.sin(self.theta(m["order"])),
                m["order"] * self.machine["frequency"],
            )
            at += m["cos"] * c + m["sin"] * d
            rate += w * (m["sin"] * c - m["cos"] * d)
        return s["gap"] - s["w"] @ self.q - at, -s["w"] @ self.v - rate

    def contact_force(self, s, gap, rate):
        return -s.get("stiffness", 0) * gap - s.get("damping", 0) * rate + s.get("preload", 0)

    def compliant(self, s, gap, rate):
        """Force of a compliant stop; its mode moves on."""
        k, c, p = s["stiffness"], s.get("damping", 0), s.get("preload", 0)
        if not s["closed"]:
            if s["surface"] > 0:
                s["surface"] = max(0.0, (s["surface"] + p / k) * math.exp(-k * STEP / c) - p / k)
            if gap < -s["surface"]:
                s["closed"], s["surface"] = True, 0.0
        force = self.contact_force(s, gap, rate)
        if s["closed"] and (gap > 0 or (s.get("opening") != "position" and force < 0)):
            s["closed"] = False
            s["surface"] = max(0.0, -gap) if c > 0 else 0.0
        return force if s["closed"] else 0.0

    def step(self):
        f = self.constant - self.damping @ self.v - self.stiffness @ self.q
        for x in self.machine.get("force", []):
            f = (
                f
                + np.array(x["cos"]) * math.cos(self.theta(x["order"]))
                + np.array(x["sin"]) * math.sin(self.theta(x["order"]))
            )
        rigid = []
        for s in self.stops:
            gap, rate = self.gap(s)
            if "restitution" not in s:
                f = f - self.compliant(s, gap, rate) * s["w"]
            elif gap < 1e-9:  # slow impacts are rest
                goal = -s["restitution"] * rate if rate < -20 * STEP else 0.0
                rigid.append([s["w"], goal - rate - s["w"] @ self.v, 0.0])
        v = self.v + STEP * (self.inverse @ f)
        held = [[j, 0.0] for j in self.joints]
        for _ in range(60):  # impulses, one after another
            change = 0.0
            for x in rigid:
                new = max(0.0, x[2] + (x[1] + x[0] @ v) / (x[0] @ self.inverse @ x[0]))
                v, change, x[2] = v - (new - x[2]) * (self.inverse @ x[0]), max(change, abs(new - x[2])), new
            for x in held:
                j, w = x[0], x[0]["w"]
                need = x[1] + (w @ v - j.get("belt", 0)) / (w @ self.inverse @ w)
                bound = STEP * (j.get("static", j["sliding"]) if j["holds"] else j["sliding"])
                new = need if abs(need) <= bound else math.copysign(STEP * j["sliding"], need)
                v, change, x[1] = v - (new - x[1]) * (self.inverse @ w), max(change, abs(new - x[1])), new
            if change < 1e-13:
                break
        for j in self.joints:
            j["holds"] = abs(j["w"] @ v - j.get("belt", 0)) < 1e-12
        self.v, self.q, self.t = v, self.q + STEP * v, self.t + STEP

    def coordinates_at(self, time):
        while self.t < time:
            self.step()
        return self.q - (self.t - time) * self.v


def main():
    count, bad = int(sys.argv[1]), 0
    for path in sys.argv[2:]:
        errors = []
        with open(path) as file:
            cases = [json.loads(line) for line in file]
        for case in cases:
            states = [(s, case["events"][s[0]]) for s in case["states"]]
            states = [(s, e) for s, e in states if 0 < e[2] < UNTIL]
            if not states or len(errors) >= count:
                continue
            stepper, worst = Stepper(case["machine"], case["start"]), 0.0
            for s, e in states:
                worst = max(worst, np.max(np.abs(stepper.coordinates_at(e[2]) - np.array(s[1]))))
            errors.append(worst)
            if worst > ALLOWED:
                bad += 1
                print(case["name"], f"differs by {worst:.1e}")
        if errors:
            print(
                f"{path}: {len(errors)} compared, median difference {np.median(errors):.1e}, largest {max(errors):.1e}",
                flush=True,
            )
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
