"""The tables of docs/python.md from the measurements of `rivals.py`."""

import statistics

OWN = ("trigon3d, 1 sample", "trigon3d")


def table(results: dict) -> str:
    return "\n\n".join([headline(results), rates(results), qualities(results), failures(results)]).strip()


def rate(row: dict, clock: str = "seconds") -> float | None:
    """Images per second, the median of the turns; with the clock "processor", for each second of all its threads."""
    return 1 / statistics.median(row[clock]) if row.get(clock) else None


def ratios(results: dict, own: str, needs: tuple[str, ...], clock: str = "seconds") -> list[float]:
    """In each case, our images per second by those of the fastest rival that gives these outputs."""
    return [
        rate(cell["renderers"][own], clock)
        / max(
            rate(row, clock)
            for name, row in cell["renderers"].items()
            if name not in OWN and row.get(clock) and set(needs) <= set(row.get("outputs", []))
        )
        for cell in results["cells"]
    ]


def headline(results: dict) -> str:
    """What the goal of five times the fastest rival came to."""
    complete = ("color", "depth", "objects")
    lines = [
        f"Measured on {results['machine']['date']}, {results['machine']['processor']}, {results['machine']['cores']} cores, "
        f"load average {min(loads(results)):.0f} to {max(loads(results)):.0f}: compare numbers of one column only."
    ]
    for own in OWN:
        beside, every = ratios(results, own, complete), ratios(results, own, ())
        lines.append(
            f"- Images per second of {own}: {span(beside)} times those of the fastest other renderer that gives colour, depth and ids (at least 5 times in "
            f"{reached(beside)}), {span(every)} times those of the fastest of all, whatever it gives (at least 5 times in {reached(every)}). "
            f"For each second of a processor, {span(ratios(results, own, complete, 'processor'))} and {span(ratios(results, own, (), 'processor'))} times."
        )
    starts = {name: statistics.median(seconds) for name, seconds in results["starts"].items() if seconds}
    if "pyrender" in starts:
        share = starts["pyrender"] / starts["trigon3d"]
        lines.append(f"- From the import to the first image: {starts['trigon3d']:.2g} s, pyrender {starts['pyrender']:.2g} s, {share:.1f} times as long.")
    return "\n".join(lines)


def span(numbers: list[float]) -> str:
    return f"{min(numbers):.2g} to {max(numbers):.2g}"


def reached(numbers: list[float]) -> str:
    return f"{sum(number >= 5 for number in numbers)} of {len(numbers)} cases"


def loads(results: dict) -> list[float]:
    return [cell["load"] for cell in results["cells"]]


def rates(results: dict) -> str:
    """Images per second of every renderer and case."""
    cells = results["cells"]
    rows = ["| images per second | gives | " + " | ".join(f"{cell['mesh']} faces, {cell['size']}" for cell in cells) + " |"]
    rows.append("|---" * (len(cells) + 2) + "|")
    for name in names(results):
        known = [cell["renderers"].get(name, {}) for cell in cells]
        given = next((row["outputs"] for row in known if row.get("outputs")), [])
        words = [{"color": "colour", "faces": "face ids", "objects": "object ids"}.get(output, output) for output in given]
        numbers = [f"{rate(row):.3g}" if rate(row) else "–" for row in known]
        rows.append(f"| {name} | {', '.join(words)} | " + " | ".join(numbers) + " |")
    return "\n".join(rows)


def qualities(results: dict) -> str:
    """Start, memory and errors, the last two in the case with the most faces that the renderer drew."""
    rows = ["| | version | first image | most memory | depth error, median and 99 % | other outline | other face |", "|---|---|---|---|---|---|---|"]
    for name in names(results):
        known = [cell["renderers"][name] for cell in results["cells"] if cell["renderers"].get(name, {}).get("seconds")]
        if not known:
            continue
        row = known[-1]
        error = row.get("depth error")
        depth = f"{error['median']:.1g}, {error['p99']:.1g}" if error else "–"
        starts = results["starts"].get(name) or [row["first"] for row in known[:1]]
        shares = [f"{row[key]:.2%}" if key in row else "–" for key in ("other outline", "other face")]
        rows.append(f"| {name} | {results['versions'][name]} | {statistics.median(starts):.2g} s | {row['peak']:.0f} MB | {depth} | {' | '.join(shares)} |")
    return "\n".join(rows)


def failures(results: dict) -> str:
    """What was not measured, and why."""
    cases = {}
    for cell in results["cells"]:
        for name, row in cell["renderers"].items():
            if "error" in row:
                cases.setdefault((name, row["error"]), []).append(f"{cell['mesh']} at {cell['size']}")
    return "\n".join(f"- {name}, {', '.join(where)}: {error}." for (name, error), where in cases.items())


def names(results: dict) -> list[str]:
    return [name for name in results["cells"][0]["renderers"] if name in results["versions"]]
