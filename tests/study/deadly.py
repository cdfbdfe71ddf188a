"""A worker that kills its process at a certain case."""
import os

from contact.study._task import solve_task


def solve(task):
    """As solve_task, but ends the process at cksi = 0.003"""
    if (task.given[:, 0] == 0.003).any():
        os._exit(1)
    return solve_task(task)
