"""Joins measurements into one file and one table: see run.sh.

    table.py JSON PART...

Exit code 1: raylane has given a wrong answer.
"""

import json
import pathlib
import sys


def load(parts):
    rows = []
    for part in parts:
        with open(part) as file:
            rows += json.load(file)["rows"]
    return rows


def users(row):
    """Returns the result for users of raylane."""
    return next((result for result in row["by"] if result["name"] == row.get("own")),
                row["by"][0])


def best_peer(row):
    peers = [result for result in row["by"]
             if not result["name"].startswith(("raylane", "library"))]
    if not peers:
        return None
    best = max if row["unit"] == "Mrays/s" else min
    return best(peers, key=lambda result: result["median"])


def cells(row):
    engine, own, peer = row["by"][0], users(row), best_peer(row)
    number = "%.2f" if row["unit"] == "Mrays/s" else "%.3f"
    wrong = ["%d" % result["wrong"] if result and "wrong" in result else ""
             for result in (engine, peer)]
    return [row["scene"], row["what"], row.get("isa", ""), str(row["threads"]), row["unit"],
            number % engine["median"] if own is not engine else "", number % own["median"],
            number % peer["median"] if peer else "",
            peer["name"] if peer else "", "%.2f" % row["ratio"] if peer else "", *wrong]


def print_table(rows):
    head = ["scene", "what", "isa", "threads", "unit", "its engine", "raylane", "best peer", "which", "ratio",
            "wrong", "its"]
    table = [head] + [cells(row) for row in rows]
    widths = [max(len(line[column]) for line in table) for column in range(len(head))]
    numbers = {3, 5, 6, 7, 9, 10, 11}
    for line in table:
        print("  ".join(cell.rjust(width) if column in numbers else cell.ljust(width)
                        for column, (cell, width) in enumerate(zip(line, widths))).rstrip())


def gain(row, result):
    more, alone = result["median"], result["alone"]
    return more / alone if row["unit"] == "Mrays/s" else alone / more


def print_scaling(rows):
    """Prints the gains of several threads over one; the runs took turns."""
    for row in rows:
        results = [result for result in (users(row), best_peer(row))
                   if result and "alone" in result]
        if results:
            print("%s, %s: %d threads are %s" % (
                row["scene"], row["what"], row["threads"],
                ", ".join("%.2f times one by %s" % (gain(row, result), result["name"])
                          for result in results)))


def main():
    output, parts = sys.argv[1], sys.argv[2:]
    rows = load(parts)
    for row in rows:
        row["scene"] = pathlib.PurePath(row["scene"]).name if row["scene"].endswith(
            (".nff", ".json")) else row["scene"]
    with open(output, "w") as file:
        json.dump({"rows": rows}, file, indent=2)
    print("\nMedians. Ratio: raylane's speed for its users relative to the best peer's. Wrong: answers that certified"
          "\narithmetic refutes; for images, pixels that differ from raylane's.\n")
    print_table(rows)
    print()
    print_scaling(rows)
    print(output)
    refuted = [row for row in rows if row["by"][0].get("wrong", 0) != 0]
    sys.exit(1 if refuted else 0)


main()
