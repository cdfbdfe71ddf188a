"""A page to look at: the results of an experiment as one HTML file, and a small server on this machine.

Works without the CONTACT library; NumPy and h5py are needed.
"""
from .page import write_page
from .read import MissingResults, read_experiment
from .server import serve

__all__ = ["MissingResults", "read_experiment", "serve", "write_page"]
