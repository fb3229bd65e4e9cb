"""What a program of the pump must show before it may end, finding by finding of the referee."""
