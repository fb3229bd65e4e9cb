"""What a program of the pump must show before it may end, for each finding of the referee."""
