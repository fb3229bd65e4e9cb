"""What every room stands on: units, poses, records, files, errors; it imports nothing of the rest."""
