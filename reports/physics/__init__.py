"""Is it the same robot after the passes for a consumer, but for the changes that the ledger lists?"""
