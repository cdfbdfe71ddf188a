"""A worker that ends its process when it meets a certain case."""
import os

from contact.study._task import solve_task


def solve(task):
    """As solve_task; cksi = 0.003 is the end"""
    if (task.given[:, 0] == 0.003).any():
        os._exit(1)
    return solve_task(task)
