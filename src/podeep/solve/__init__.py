"""Equilibrium: Newton with a line search, load steps, error estimates."""
