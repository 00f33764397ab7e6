"""Golden cases of first: scipy's zero-order-hold model of b/(s + a).

Stable, integrator and unstable; parameters that change while it runs; a bad input holds.
"""
import math

import numpy as np
from scipy.signal import cont2discrete

import golden


def model(a, b, period):
    e, g, *_ = cont2discrete((np.array([[-a]]), np.array([[b]]), np.eye(1), np.zeros((1, 1))), period)
    return e[0, 0], g[0, 0]


def lags():
    period, steps = 0.1, 120
    blocks = {"y1": [2.0, 3.0, 0.5], "y2": [0.0, 0.7, -1.0], "y3": [-0.4, 0.2, 0.1], "y4": [1e-9, 1.0, 0.0], "y5": [80.0, 40.0, 7.0]}
    program = "! Lags: stable, integrator, unstable, nearly an integrator, much faster than the period.\nCONTROL\n"
    program += "1 u = ain ( : 0, 1, 1 )\n"
    for i, (name, (a, b, x0)) in enumerate(blocks.items()):
        program += f"{i + 2} {name} = first ( u : {a}, {b}, {x0} )\n"
    program += "END\n"
    state = {name: p[2] for name, p in blocks.items()}
    stimulus, trace = [], []
    for k in range(steps):
        u = math.nan if 40 <= k < 44 else round(math.sin(0.3 * k) + (1.0 if k > 20 else 0.0), 6)
        a1 = 5.0 if k >= 60 else 2.0
        b2 = -0.25 if k >= 80 else 0.7
        stimulus.append([k, u, a1, b2])
        for name, (a, b, _) in blocks.items():
            e, g = model(a1 if name == "y1" else a, b2 if name == "y2" else b, period)
            if math.isfinite(u):
                state[name] = e * state[name] + g * u
        trace.append([k] + list(state.values()))
    golden.write("first_lags", program, (["ain(0,1,1)", "y1.a", "y2.b"], stimulus), (list(blocks), trace),
                 "scipy's matrix exponential against expm1", period=period)


def before_the_first_scan():
    program = """
! A loop that reads the lag before it is written: the first value read is x0.
CONTROL
1 e = sumII ( 1, w, y, 2 : 1., -1. )    ! warning: P0301
2 y = first ( e : 1., 4., 2.5 )
3 w = msc ( : 1. )
END
"""
    e, g = model(1.0, 4.0, 0.1)
    y, w, trace = 2.5, 0.0, []
    for k in range(40):
        error = w - y
        y = e * y + g * error
        w = 1.0
        trace.append([k, error, y])
    golden.write("first_initial_output", program, (["w.value"], [[k, 1.0] for k in range(40)]), (["e", "y"], trace),
                 "scipy's matrix exponential against expm1", period=0.1)


lags()
before_the_first_scan()
