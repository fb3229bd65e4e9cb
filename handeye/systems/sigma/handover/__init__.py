"""The hand-over: arm 1 brings pieces to a place that both arms share, and arm 2 finishes them and takes them away."""
