"""Formulae in text, for constraints and derived quantities: only names, numbers, operators and a few functions."""
from __future__ import annotations

import ast
import operator
from collections.abc import Mapping
from typing import Any, Callable

import numpy as np

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv, ast.Pow: operator.pow,
    ast.Mod: operator.mod}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge, ast.Eq: operator.eq,
    ast.NotEq: operator.ne}
_UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Not: np.logical_not}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: getattr(np, name) for name in ("abs sqrt exp log log10 sin cos tan arctan arctan2 hypot minimum maximum sign isfinite "
                                         "radians degrees").split()}
_CONSTANTS = {"pi": float(np.pi)}


def names_in(text: str) -> set[str]:
    """The names used in a formula."""
    return {node.id for node in ast.walk(_parsed(text)) if isinstance(node, ast.Name)} - set(FUNCTIONS) - set(_CONSTANTS)


def evaluate(text: str, names: Mapping[str, Any]) -> Any:
    """The value of a formula.

    Parameters
    ----------
    text
        For instance ``"abs(fx * cksi) + abs(fy * ceta)"``; ``and``, ``or`` and ``not`` act on each element.
    names
        Values of the names: numbers, arrays or xarray variables.

    Raises
    ------
    ValueError
        If it is not a formula, or uses an unknown name.
    """
    return _value(_parsed(text).body, text, names)


def _parsed(text: str) -> ast.Expression:
    try:
        return ast.parse(text.strip(), mode="eval")
    except SyntaxError as reason:
        raise ValueError(f"'{text}' is no formula: {reason.msg}") from reason


def _value(node: ast.AST, text: str, names: Mapping[str, Any]) -> Any:
    """Value of a node of the syntax tree"""
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float, bool, str)):
        return node.value
    if isinstance(node, ast.Name):
        if node.id in names:
            return names[node.id]
        if node.id in _CONSTANTS:
            return _CONSTANTS[node.id]
        raise ValueError(f"'{text}' asks for '{node.id}', which is not there; there are {', '.join(sorted(names))}")
    if isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        return _BINARY[type(node.op)](_value(node.left, text, names), _value(node.right, text, names))
    if isinstance(node, ast.UnaryOp) and type(node.op) in _UNARY:
        return _UNARY[type(node.op)](_value(node.operand, text, names))
    if isinstance(node, ast.BoolOp):
        join = np.logical_and if isinstance(node.op, ast.And) else np.logical_or
        result = _value(node.values[0], text, names)
        for other in node.values[1:]:
            result = join(result, _value(other, text, names))
        return result
    if isinstance(node, ast.Compare):
        left = _value(node.left, text, names)
        result = None
        for kind, other in zip(node.ops, node.comparators):
            if type(kind) not in _COMPARE:
                break
            right = _value(other, text, names)
            one = _COMPARE[type(kind)](left, right)
            result = one if result is None else np.logical_and(result, one)
            left = right
        else:
            return result
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS and not node.keywords:
        return FUNCTIONS[node.func.id](*(_value(part, text, names) for part in node.args))
    raise ValueError(f"'{text}': {ast.unparse(node)} is not allowed in a formula; there are + - * / % **, comparisons, and, or, "
                     f"not, {', '.join(sorted(FUNCTIONS))}")
