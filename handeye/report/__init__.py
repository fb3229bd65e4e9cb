"""Makes reports on runs from traces and results. Nothing is executed."""
