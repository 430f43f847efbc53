"""Podeep's dialogue: questions as data, consoles that ask them, the flow that knows neither."""
