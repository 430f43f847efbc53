"""Beam elements: shape functions, sections and the operators they integrate to."""
