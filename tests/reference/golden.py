"""Writes a golden case: the program, its stimulus and the trace that an independent computation expects."""
from pathlib import Path

CASES = Path(__file__).resolve().parent.parent / "cases"


def number(value):
    """Shortest text that reads back; empty for no value, nan as the traces write it."""
    if value is None:
        return ""
    if isinstance(value, (bool, int)):
        return str(int(value))
    return repr(float(value))


def table(path, header, rows):
    def quoted(name):
        return f'"{name}"' if "," in name else name

    lines = [",".join(quoted(name) for name in header)]
    lines += [",".join(number(cell) for cell in row) for row in rows]
    path.write_text("\n".join(lines) + "\n")


def write(name, program, stimulus, trace, reason, relative=1e-9, absolute=1e-12, period=0.25, single=None):
    """stimulus and trace are (header, rows); row k of the trace stands after scan k.

    single is (relative, reason) or (relative, reason, absolute) where floats need other than the harness gives them."""
    folder = CASES / name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "main.cfg").write_text(program.strip("\n") + "\n")
    (folder / "pcl2.toml").write_text(
        f'[controller]\nname = "{name}"\nsource = "main.cfg"\nperiod = {period}\n')
    table(folder / "stimulus.csv", ["k"] + stimulus[0], stimulus[1])
    table(folder / "trace.csv", ["@k"] + trace[0], trace[1])
    (folder / "case.toml").write_text(
        f"steps = {len(trace[1])}\nrelative = {relative}\nabsolute = {absolute}\n"
        f'reason = "{reason}"\n'
        + (f'\n[f32]\nrelative = {single[0]}\nreason = "{single[1]}"\n' if single else "")
        + (f"absolute = {single[2]}\n" if single and len(single) > 2 else ""))
