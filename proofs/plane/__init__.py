"""The plane of parameters: what is proved in boxes of (eta, nu)."""
