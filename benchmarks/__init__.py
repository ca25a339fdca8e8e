"""This project and its peers, side by side: `uv run --group bench python -m benchmarks`."""
