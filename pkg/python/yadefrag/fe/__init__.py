"""Finite-element bodies: methods of FESolver in Python, outlines for it, and its results."""
