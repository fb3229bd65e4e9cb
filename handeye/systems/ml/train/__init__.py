"""The job `train`: an engine and two wagons are coupled, peg in hole, and pulled."""
