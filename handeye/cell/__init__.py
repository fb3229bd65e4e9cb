"""The work cell: abstract ports, and the simulated cell behind them. Importing this package needs no MuJoCo."""
