"""The facts about failures in a plan or a run, and the sentences that state these facts."""
