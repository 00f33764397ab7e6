"""Golden case of noise, from PCG32 and the polar method written anew, and judged here.

The generator by the numbers of its author's demonstration (seed 42, sequence 54); the noise of forty seeds by its
moments, by the Kolmogorov-Smirnov distance, and by its likeness to itself and to that of the next seed.
"""
import math

from scipy import stats

import golden

MASK = 2**64 - 1


class Pcg32:
    def __init__(self, seed, sequence):
        self.increment = 2 * sequence + 1
        self.state = 0
        self.next()
        self.state = (self.state + seed) & MASK
        self.next()

    def next(self):
        old = self.state
        self.state = (old * 6364136223846793005 + self.increment) & MASK
        word = ((old >> 18) ^ old) >> 27 & 0xFFFFFFFF
        turn = old >> 59
        return (word >> turn | word << (32 - turn)) & 0xFFFFFFFF


class Gauss:
    def __init__(self, seed):
        self.generator = Pcg32(seed % 2**32, 54)
        self.kept = []

    def next(self):
        while not self.kept:
            u, v = ((self.generator.next() >> 8) / 2**23 - 1 for _ in range(2))
            s = u * u + v * v
            if 0 < s < 1:
                size = math.sqrt(-2 * math.log(s) / s)
                self.kept = [v * size, u * size]
        return self.kept.pop()


def check():
    demonstration = [0xA15C02B7, 0x7B47F409, 0xBA1D3330, 0x83D2F293, 0xBFA4784B, 0xCBED606E]
    generator = Pcg32(42, 54)
    assert [generator.next() for _ in demonstration] == demonstration
    runs = []
    for seed in range(40):
        gauss = Gauss(seed)
        runs.append([gauss.next() for _ in range(10_000)])
    sample = sum(runs, [])
    described = stats.describe(sample)
    deviations = math.sqrt(len(sample))
    assert abs(described.mean) * deviations < 3
    assert abs(described.variance - 1) * deviations / math.sqrt(2) < 3
    assert abs(described.skewness) * deviations / math.sqrt(6) < 3
    assert abs(described.kurtosis) * deviations / math.sqrt(24) < 3
    assert stats.kstest(sample, "norm").pvalue > 0.01
    echo = sum(a * b for a, b in zip(sample, sample[1:])) / deviations
    likeness = sum(a * b for one, two in zip(runs, runs[1:]) for a, b in zip(one, two)) / deviations
    assert abs(echo) < 3 and abs(likeness) < 3


def case():
    program = """
! Noise in the plant; it is off for a while, its size changes, and another seed gives another sequence.
PLANT
1 en = msi ( : 1 )
2 on = msi ( : 1 )
3 a = noise ( en : 0.5, 2., 42 )
4 b = noise ( on : )
5 c = noise ( on : 0., 1., -7 )
CONTROL
6 z = sumII ( 1, a, b, 2 : 1., 1. )
END
"""
    a, b, c = Gauss(42), Gauss(1), Gauss(-7)
    stimulus, trace = [], []
    for k in range(400):
        en = 0 if 50 <= k < 55 else 1
        size = 0.25 if k >= 200 else 2.0
        stimulus.append([k, en, size])
        noise = 0.5 + size * a.next() if en else 0.0
        trace.append([k, noise, b.next(), c.next()])
    golden.write("noise_sequences", program, (["en.value", "a.sd"], stimulus), (list("abc"), trace),
                 "libm's logarithm against our own", period=0.1)


check()
case()
