"""What the seabed does to a pipe that lies on it."""
