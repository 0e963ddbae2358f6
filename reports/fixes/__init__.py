"""Are files the same robots after `check --fix`, and how much does it mend?"""
