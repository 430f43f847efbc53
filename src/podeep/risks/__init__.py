"""Risks: what is legal in a scene but may not be meant, or not hold."""
