"""SUPERSIGMA (Milan, 1981): a brain, microcomputers on a bus, and a language of tasks and flags."""
