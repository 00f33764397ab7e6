"""Golden cases of trfun (Runge-Kutta by hand, in numpy) and tf (scipy's zero-order-hold model).

Orders 1 to 5, direct feed-through, integrators, unstable and stiff plants; a bad input holds.
"""
import math

import numpy as np
from scipy.signal import cont2discrete

import golden

PERIOD = 0.1

# name: (den, num, x0), descending powers, the leading 1 of den dropped
PLANTS = {
    "y1": ([2.0], [4.0], [0.5]),
    "y2": ([3.0, 2.0], [1.0], [0.0, 0.0]),
    "y3": ([6.0, 11.0, 6.0], [0.5, -1.0, 6.0], [0.1, -0.2, 0.3]),
    "y4": ([4.0, 6.0, 4.0, 1.0], [1.0], [0.0, 0.0, 0.0, 0.0]),
    "y5": ([5.1, 9.2, 8.4, 4.6, 1.3], [1.0, 0.2, 1.3], [0.0] * 5),
    "through": ([0.8, 1.0], [2.0, 1.0, 3.0], [0.25, 0.0]),
    "double": ([0.0, 0.0], [1.0, 0.5], [0.0, 1.0]),
    "unstable": ([-0.3, 0.5], [1.0], [0.05, 0.0]),
}


def matrices(den, num):
    n = len(den)
    a = np.eye(n, k=1)
    a[-1] = -np.array(den[::-1])
    b = np.zeros((n, 1))
    b[-1] = 1.0
    padded = np.concatenate((np.zeros(n + 1 - len(num)), num))
    d = padded[0]
    c = (padded[1:] - d * np.array(den))[::-1].reshape(1, n)
    return a, b, c, d


class RungeKutta:
    def __init__(self, den, num, x0):
        self.a, self.b, self.c, self.d = matrices(den, num)
        self.x = np.array(x0, dtype=float).reshape(-1, 1)
        self.y = (self.c @ self.x)[0, 0]

    def advance(self, u):
        def slope(x):
            return self.a @ x + self.b * u
        h = PERIOD
        k1 = slope(self.x)
        k2 = slope(self.x + h / 2 * k1)
        k3 = slope(self.x + h / 2 * k2)
        k4 = slope(self.x + h * k3)
        self.x = self.x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    def step(self, u):
        if math.isfinite(u):
            self.advance(u)
            self.y = (self.c @ self.x)[0, 0] + self.d * u
        return self.y


class Exact(RungeKutta):
    def __init__(self, den, num, x0):
        super().__init__(den, num, x0)
        self.f, self.g, *_ = cont2discrete((self.a, self.b, self.c, np.array([[self.d]])), PERIOD)

    def advance(self, u):
        self.x = self.f @ self.x + self.g * u


def call(code, den, num, x0):
    values = ", ".join(repr(v) for v in den + num + x0)
    return f"{code} ( u, {len(den)}, {len(num)}, {len(den)} : {values} )"


def case(name, code, model, plants, comment, reason):
    steps = 100
    program = f"! {comment}\nCONTROL\n1 u = ain ( : 0, 1, 1 )\n"
    for i, (output, plant) in enumerate(plants.items()):
        program += f"{i + 2} {output} = {call(code, *plant)}\n"
    program += "END\n"
    models = [model(*plant) for plant in plants.values()]
    stimulus, trace = [], []
    for k in range(steps):
        u = math.nan if 50 <= k < 53 else round((1.0 if k >= 5 else 0.0) - (1.5 if k >= 60 else 0.0) + 0.3 * math.sin(0.7 * k), 6)
        stimulus.append([k, u])
        trace.append([k] + [m.step(u) for m in models])
    golden.write(name, program, (["ain(0,1,1)"], stimulus), (list(plants), trace), reason, period=PERIOD)
    return trace


def retuned():
    program = """
! The denominator changes while the plant runs; the state goes on.
CONTROL
1 u = msc ( : 1. )
2 y = trfun ( u, 2, 2, 2 : 1., 1., 0.5, 1., 0., 0. )
3 z = tf ( u, 2, 2, 2 : 1., 1., 0.5, 1., 0., 0. )
END
"""
    den, num = [1.0, 1.0], [0.5, 1.0]
    y, z = RungeKutta(den, num, [0.0, 0.0]), Exact(den, num, [0.0, 0.0])
    stimulus, trace = [], []
    for k in range(60):
        den = [1.0, 4.0 if k >= 25 else 1.0]
        for m in (y, z):
            new = type(m)(den, num, [0.0, 0.0])
            new.x, m.__dict__ = m.x, new.__dict__
        stimulus.append([k, den[1], den[1]])
        trace.append([k, y.step(1.0), z.step(1.0)])
    golden.write("trfun_retuned", program, (["y.den[2]", "z.den[2]"], stimulus), (["y", "z"], trace),
                 "another order of the sums", period=PERIOD)


runge_kutta = case("trfun_plants", "trfun", RungeKutta, PLANTS, "One Runge-Kutta step a scan.", "another order of the sums")
stiff = dict(PLANTS, stiff=([1010.5, 10505.0, 5000.0], [5000.0], [0.0, 0.0, 0.0]))
exact = case("tf_plants", "tf", Exact, stiff, "Exact under a held input; one plant is too stiff for trfun.",
             "scipy's matrix exponential against scaling and squaring of exp(A) - 1")
assert max(abs(a - b) for p, q in zip(runge_kutta, exact) for a, b in zip(p, q)) < 1e-4
retuned()
