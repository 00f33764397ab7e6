"""Golden case of digital inputs and outputs: rows of scans, typed in by the rules of their declarations."""
from logic import table

table("io_digital", "Digital inputs with debouncing, outputs with fail states, a watchdog.", {
    "din(0,1,1)": " . 1 . 1 1 1 1 1 . . 1 . . . . .",
    "din(0,1,2)": " 4 . 4 4 . . . . . . . . . . . .",
    "beat.value": " . 1 . 1 . . . . . . 1 . 1 . 1 .",
}, """
CONTROL
1 beat = msi ( : 0 )
2 p = din ( : 0, 1, 1, )
3 d = din ( : 0, 1, 1, 0.3 )
4 e = din ( : 0, 1, 2, 0.3 )
5 w = wdog ( beat : 0.3 )
6 ok = not ( w : )
7 n = not ( p : )
8 O = dout ( p, ok : 0, 2, 1, )
9 N = dout ( p, ok : 0, 2, 2, on )
10 H = dout ( n, ok : 0, 2, 3, hold )
END
""", {
    "p": ". 1 . 1 1 1 1 1 . . 1 . . . . .",
    "d": ". . . . . . 1 1 1 1 1 1 1 1 . .",
    "e": "1 1 1 1 1 1 1 . . . . . . . . .",
    "w": ". . . . . . . 1 1 1 . . . . . .",
    "O": ". 1 . 1 1 1 1 . . . 1 . . . . .",
    "N": ". 1 . 1 1 1 1 1 1 1 1 . . . . .",
    "H": "1 . 1 . . . . . . . . 1 1 1 1 1",
})
