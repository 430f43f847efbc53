"""Soil reaction laws, one frozen dataclass each, and the profile that spreads them over depth."""
