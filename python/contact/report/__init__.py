"""`contact report`: the results of an experiment as one HTML file, and a small server on this machine.

Does not use the CONTACT library; requires NumPy and h5py.
"""
from .page import write_page
from .read import MissingResults, read_experiment
from .server import serve

__all__ = ["MissingResults", "read_experiment", "serve", "write_page"]
