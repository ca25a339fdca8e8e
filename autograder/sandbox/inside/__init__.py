"""What runs beside the student: started by the trusted side, believed by nobody."""
