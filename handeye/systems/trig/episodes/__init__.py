"""The palletiser as a Gymnasium environment."""
