"""Golden case of prbs: scipy's max_len_seq, whose polynomials are the same for every order.

The period of each order, 2^n - 1, is checked on the way, by running the register of the polynomial that the declaration
names.
"""
from pathlib import Path
import re

import numpy as np
from scipy.signal import max_len_seq

import golden

DECLARATION = Path(__file__).resolve().parents[2] / "blocks/dynamics/prbs.fc"


def polynomials():
    """order: exponents, as the declaration's comment has them."""
    found = {}
    for order, terms in re.findall(r"(\d+): (x\^[\dx^+]+)", DECLARATION.read_text()):
        exponents = [0 if term == "1" else 1 if term == "x" else int(term[2:]) for term in terms.split("+")]
        found[int(order)] = exponents
    return found


def sequence(order, exponents):
    """One period of s(k + n) = sum of s(k + e), from ones; the register must be back for the first time then."""
    state = [1] * order
    bits = []
    while True:
        bits.append(state[0])
        state = state[1:] + [sum(state[e] for e in exponents if e < order) % 2]
        if all(state):
            return bits


def check():
    table = polynomials()
    assert sorted(table) == list(range(3, 17))
    for order, exponents in table.items():
        bits = sequence(order, exponents)
        assert len(bits) == 2**order - 1, order
        assert np.array_equal(bits, max_len_seq(order)[0]), order


def case():
    steps = 300
    orders = {f"p{order}": order for order in range(3, 17)}
    program = "! Sequences of every order, one with bits of three scans, one that is off for a while.\nCONTROL\n"
    program += "1 on = msi ( : 1 )\n2 en = msi ( : 1 )\n"
    for i, (name, order) in enumerate(orders.items()):
        program += f"{i + 3} {name} = prbs ( on : 1.5, {order}, 1 )\n"
    program += f"{len(orders) + 3} slow = prbs ( en : 2., 5, 3 )\nEND\n"
    bits = {name: max_len_seq(order, length=steps)[0] for name, order in orders.items()}
    slow = np.repeat(max_len_seq(5, length=steps)[0], 3)
    stimulus, trace, at = [], [], 0
    for k in range(steps):
        on = 0 if 40 <= k < 50 else 1
        amp = 0.5 if k >= 100 else 2.0
        stimulus.append([k, on, amp])
        row = [1.5 if bits[name][k] else -1.5 for name in orders]
        row.append((amp if slow[at] else -amp) if on else 0.0)
        at += on
        trace.append([k] + row)
    golden.write("prbs_orders", program, (["en.value", "slow.amp"], stimulus), (list(orders) + ["slow"], trace),
                 "bits", period=0.1)


check()
case()
