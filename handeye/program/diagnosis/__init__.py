"""Diagnosis: facts about what fails in a plan or a run, and their sentences."""
