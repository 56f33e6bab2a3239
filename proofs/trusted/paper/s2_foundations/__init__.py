"""Section 2: free flight, launch, impact relations, sticking."""
