"""Names the places of `performance_bench --allocations`: name_places.py PROGRAM < its output

Prints a table of requests to the heap per case, with the innermost frames that have a name in
the project. Without addr2line (binutils) addresses are printed as numbers.
"""
import re
import subprocess
import sys

CASES = 50


def names(program, addresses):
    """Function and line of each address, inlined frames included"""
    try:
        out = subprocess.run(["addr2line", "-f", "-i", "-a", "-e", program, *addresses],
                             capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return {}
    found, lines, address = {}, out.splitlines(), None
    for k, line in enumerate(lines):
        if line.startswith("0x"):
            address, start = int(line, 16), k + 1
            found[address] = []
        elif (k - start) % 2 == 0 and k + 1 < len(lines):
            place = re.sub(r" \(discriminator.*", "", lines[k + 1])
            found[address].append((line, place))
    return found


def main():
    program = sys.argv[1]
    text = sys.stdin.read()
    places = [line.split()[1:] for line in text.splitlines() if line.startswith("PLACE")]
    if not places:
        print("No requests to the heap in repeated cases, or they cannot be counted here.")
        return
    known = names(program, sorted({a for place in places for a in place[1:]}))
    rows = {}
    for count, *stack in places:
        frames = []
        for address in stack:
            for _function, where in known.get(int(address, 16), []):
                match = re.search(r"/src/(.*\.f90:\d+)", where)
                if match:
                    frames.append(match.group(1))
        key = " < ".join(dict.fromkeys(frames[:3])) or "outside the project"
        rows[key] = rows.get(key, 0) + int(count)
    print(f"Requests to the heap per case: {sum(rows.values()) / CASES:.0f}\n")
    print("| per case | where < called from |\n|---|---|")
    for key, count in sorted(rows.items(), key=lambda item: -item[1]):
        print(f"| {count / CASES:.1f} | {key} |")


main()
