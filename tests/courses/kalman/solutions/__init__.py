"""What students never get: the key, references and known mistakes."""
