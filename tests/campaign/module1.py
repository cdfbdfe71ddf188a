"""The kind of case "wheel on rail or roller" for run.py: scenes of scene1.py, judged by judge1.py"""
from judge1 import check
from scene1 import files, generate, labels, reduce

__all__ = ["check", "files", "generate", "labels", "reduce"]
