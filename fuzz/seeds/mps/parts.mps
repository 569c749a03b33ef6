NAME parts
ROWS
 N obj
 E first
 E second
COLUMNS
 MARKER 'MARKER' 'INTORG'
 a obj 1.5 first 2
 b first 3 second -1e3
 MARKER 'MARKER' 'INTEND'
 c obj -1 second 0.5
RHS
 RHS obj -4 first 1
 RHS second 2
BOUNDS
 FR BND a
 FR BND b
 FR BND c
QUADOBJ
 a a 2
 a c -1
 c c 4
ENDATA
