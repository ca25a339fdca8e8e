"""Lines: fitting them to points, and extracting them from laser scans."""
