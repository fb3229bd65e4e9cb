"""The job `train`: an engine and two wagons are coupled by pegs in holes, and pulled."""
