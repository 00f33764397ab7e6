"""Golden cases of nn: numpy matrices; the gradient is checked by central differences each scan."""
import math

import numpy as np

import golden


class Nn:
    def __init__(self, m, n, h, eta, alpha, weights):
        self.m, self.n, self.h, self.eta, self.alpha = m, n, h, eta, alpha
        self.w = np.array(weights)
        self.dw = np.zeros_like(self.w)
        self.o = np.zeros(m)

    def layers(self, w):
        split = (self.n + 1) * self.h
        return w[:split].reshape(self.h, self.n + 1), w[split:].reshape(self.m, self.h + 1)

    def forward(self, w, x):
        hidden, output = self.layers(w)
        z = np.tanh(hidden @ np.append(x, 1.0))
        return z, output @ np.append(z, 1.0)

    def gradient(self, x, t):
        _, output = self.layers(self.w)
        z, o = self.forward(self.w, x)
        back = (output[:, :-1].T @ (o - t)) * (1.0 - z * z)
        slope = np.concatenate((np.outer(back, np.append(x, 1.0)).ravel(),
                                np.outer(o - t, np.append(z, 1.0)).ravel()))
        self.check(slope, x, t)
        return slope

    def check(self, slope, x, t):
        def cost(w):
            return 0.5 * np.sum((self.forward(w, x)[1] - t) ** 2)

        for i in range(len(self.w)):
            step = np.zeros_like(self.w)
            step[i] = 1e-5
            difference = (cost(self.w + step) - cost(self.w - step)) / 2e-5
            assert abs(difference - slope[i]) < 1e-6 * max(1.0, abs(slope[i])), (i, difference, slope[i])

    def scan(self, x, t, en):
        if not np.all(np.isfinite(x)):
            return list(self.o)
        self.o = self.forward(self.w, x)[1]
        if math.isfinite(en) and en != 0.0 and np.all(np.isfinite(t)):
            self.dw = -self.eta * self.gradient(x, t) + self.alpha * self.dw
            self.w = self.w + self.dw
        return list(self.o)


def start(count, seed):
    return [round(float(v), 3) for v in np.random.default_rng(seed).uniform(-0.7, 0.7, count)]


def listed(values):
    """A parameter list over several lines."""
    rows = [values[i:i + 8] for i in range(0, len(values), 8)]
    return ",\n    ".join(", ".join(str(v) for v in row) for row in rows)


def train():
    w1, w2 = start(4 * 5 + 6 * 2, 4), start(2 * 3 + 4 * 1, 5)
    program = f"""
! Two networks learn on line; en is 0 in scans 60 to 79 and not a number in 90, x[2] is bad in 100.
CONTROL
1 a = ain ( : 0, 1, 1 )
2 b = ain ( : 0, 1, 2 )
3 ta = ain ( : 0, 1, 3 )
4 tb = ain ( : 0, 1, 4 )
5 en = ain ( : 0, 1, 5 )
6 x = ftov ( 3, a, 1 : )
7 x = ftov ( 3, b, 2 : )
8 x = ftov ( 3, ta, 3 : )
9 t = ftov ( 2, ta, 1 : )
10 t = ftov ( 2, tb, 2 : )
11 o = nn ( 2, x, t, en, 3, 5 : 0.1, 0.5,
    {listed(w1)} )
12 v = ftov ( 1, a, 1 : )
13 s = ftov ( 1, tb, 1 : )
14 q = nn ( 1, v, s, en, 1, 3 : 0.05, 0.,
    {listed(w2)} )
END
"""
    first, second = Nn(2, 3, 5, 0.1, 0.5, w1), Nn(1, 1, 3, 0.05, 0.0, w2)
    stimulus, trace = [], []
    for k in range(150):
        a, b = round(math.sin(0.3 * k), 6), round(math.cos(0.17 * k), 6)
        ta, tb = round(0.5 * a * b, 6), round(a * a - 0.3, 6)
        en = 0.0 if 60 <= k < 80 else math.nan if k == 90 else 1.0
        b_read = math.nan if k == 100 else b
        stimulus.append([k, a, b_read, ta, tb, en])
        trace.append([k] + first.scan(np.array([a, b_read, ta]), np.array([ta, tb]), en)
                     + second.scan(np.array([a]), np.array([tb]), en))
    golden.write("nn_train", program, ([f"ain(0,1,{i})" for i in range(1, 6)], stimulus),
                 (["o[1]", "o[2]", "q[1]"], trace),
                 "numpy's tanh and another order of the sums; rounding of the weights adds up")


def closed_loop():
    w = start(3 * 4 + 5, 6)
    program = f"""
! A network learns the next y of a lag that it drives: u is a set-point minus what it expects.
CONTROL
1 y = first ( u : 1.0, 1.0, 0.0 )
2 w = msc ( : 0. )
3 en = msc ( : 1. )
4 x = ftov ( 2, u, 1 : )
5 x = ftov ( 2, y, 2 : )
6 t = ftov ( 1, y, 1 : )
7 o = nn ( 1, x, t, en, 2, 4 : 0.05, 0.3,
    {listed(w)} )
8 u = sumII ( 1, w, o[1], 2 : 1., -0.5 )
END
"""
    net, hold = Nn(1, 2, 4, 0.05, 0.3, w), math.exp(-0.25)
    y = u = 0.0
    stimulus, trace = [], []
    for k in range(150):
        level = [1.0, 0.2, -0.4][k // 30 % 3]
        y = hold * y + (1.0 - hold) * u
        o = net.scan(np.array([u, y]), np.array([y]), 1.0)
        u = level - 0.5 * o[0]
        stimulus.append([k, level])
        trace.append([k, y] + o + [u])
    golden.write("nn_closed_loop", program, (["w.value"], stimulus), (["y", "o[1]", "u"], trace),
                 "rounding goes around the loop")


if __name__ == "__main__":
    train()
    closed_loop()
