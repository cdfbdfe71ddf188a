#!/usr/bin/env python3
"""The schema of the JSON lines in doc/user/results.schema.json is that of the sources

Usage: json_schema.py [--write]. Names, units and descriptions come from the lists of totals and from src/output/case_record.f90 and
json_file.f90; with --write they are put into the file, without it the file is compared with them.
"""
import json
import re
import sys

from result_tables import TOP, procedure, totals

FILE = TOP / "doc/user/results.schema.json"
CALL = re.compile(r'(if \(.*\) +)?call record%(count|flag|text|number)\((problem // )?"(\w+)", (?:"([^"]*)", )?"([^"]*)"')
PROBLEMS = ("normal", "tangential", "friction")
WORDS = {"status": ["solved", "not converged", "refused"], "side": ["left", "right"]}
KINDS = {"count": {"type": "integer"}, "flag": {"type": "boolean"}, "text": {"type": "string"}}


def quantity(unit, meaning):
    """A real number, with its unit where it has one; null stands for a value that does not exist"""
    if not unit:
        return {"description": meaning, "type": ["number", "null"]}
    return {"description": meaning, **group({"value": {"type": ["number", "null"]}, "unit": {"const": unit}}, ["value", "unit"])}


def group(members, required=(), meaning=""):
    found = {"description": meaning} if meaning else {}
    return {**found, "type": "object", "properties": members, "required": list(required), "additionalProperties": False}


def members(name, prefixes=("",)):
    """The values written by a procedure of case_record, and which of them always"""
    found, always, open_groups, conditional = {}, [], 0, False
    for line in procedure("output/case_record.f90", name):
        open_groups += line.startswith("call record%open_group") - line.startswith("call record%close_group")
        if re.match(r"if \(.*\) return$", line):
            conditional = True
        call = CALL.match(line)
        if not call or (open_groups and name in ("describe_head", "describe_wheel_rail")):
            continue
        alone, kind, prefixed, word, unit, meaning = call.groups()
        for prefix in prefixes if prefixed else ("",):
            title = prefix + word
            found[title] = quantity(unit, meaning) if kind == "number" else {"description": meaning, **KINDS[kind]}
            if word in WORDS:
                found[title] = {"description": meaning, "enum": WORDS[word]}
            if not (alone or conditional or prefixed):
                always.append(title)
    return found, always


def listed(file, name):
    """A list of totals"""
    return {title: quantity(unit, meaning) if unit else {"description": meaning, "type": "integer"}
            for title, unit, meaning, *_ in totals(file, name)}


def errors(members_of_totals):
    """Estimated errors of totals"""
    found = {name + "_error": {**item, "description": "estimated error of " + name} for name, item in members_of_totals.items()
             if item["type"] == "object"}
    return group({**found, **members("describe_errors")[0]}, (), "with --errors")


def schema():
    head, always = members("describe_head")
    solver, _ = members("describe_solution")
    solver.update(members("describe_report", PROBLEMS)[0])
    patch_totals = {**listed("patch/result.f90", "totals"), **listed("wheelrail/result.f90", "patch_totals")}
    stresses = listed("patch/result.f90", "add_stresses")
    accuracy = group(*members("describe_accuracy"), "with --accuracy")
    border, coarse = members("describe_border"), members("describe_resolution")
    run, run_always = members("describe_run")
    patch = group({"patch": {"description": "number of the patch in its case", **KINDS["count"]},
                   "effects": {"description": "effects that acted", **KINDS["text"]},
                   "totals": group({**patch_totals, **listed("patch/result.f90", "add_wear"), **stresses},
                                   ["fn", "pen"]),
                   "errors": errors({**patch_totals, **stresses}), "accuracy": accuracy,
                   "border": group(border[0], border[0], "where contact is cut off"),
                   "coarse": group(coarse[0], coarse[0], "how few elements wide contact is"), "solver": group(solver)},
                  ["patch", "totals", "solver"])
    pair_totals = listed("wheelrail/result.f90", "wheel_rail_totals")
    case = group({**head, "cases_planned": {"description": "cases of the input", **KINDS["count"]},
                  "side": {"description": "side of the track", "enum": WORDS["side"]},
                  "totals": group(pair_totals, (), "forces and position of wheel and rail"), "errors": errors(pair_totals),
                  "accuracy": accuracy, **members("describe_wheel_rail")[0],
                  "buried": group({end: {"description": "an end of the wheel profile within the rail", **KINDS["text"]}
                                   for end in ("inner", "outer")}),
                  "patches": {"type": "array", "items": patch}}, [*always, "cases_planned", "patches"], "one case")
    end = group({"case": {"const": 0}, "solved": {"type": "boolean"}, "converged": {"type": "boolean"},
                 "status": {"const": "end of run"}, "patches": {"type": "array", "items": False}, "run": group(run, run_always)},
                ["case", "status", "patches", "run"], "the last line")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "a line of EXPNAM.jsonl, written by contact --json",
            "anyOf": [case, end]}


def main():
    current = json.dumps(schema(), indent=1) + "\n"
    for inner in (r"\{[^{}]*\}", r"\[[^][{}]*\]", r"\{ ?\"desc[^{}]*\{[^{}]*\{[^{}]*\}[^{}]*\{[^{}]*\}[^{}]*\}[^{}]*\}"):
        current = re.sub(inner, lambda found: re.sub(r"\s+", " ", found.group(0)), current)
    if "--write" in sys.argv:
        FILE.write_text(current)
    elif not FILE.exists() or FILE.read_text() != current:
        sys.exit("doc/user/results.schema.json is not current: python3 tests/house/json_schema.py --write")
    print("doc/user/results.schema.json has the members of the sources")


if __name__ == "__main__":
    main()
