"""Piles and casings on P-y, T-z, Q-z soil reactions, and Podeep's questions about them."""

__version__ = "0.1.0"
