"""Commands of SUPERSIGMA."""
