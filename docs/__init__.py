"""Pages of the documentation, and the programs that convert them to a site."""
