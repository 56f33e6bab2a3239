"""The commands that only name a group of claims: one table, and what one of them shows beside."""
