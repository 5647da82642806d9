"""Hash-consed expression DAG, one operator table, derivatives by automatic differentiation on the DAG, isolation."""
