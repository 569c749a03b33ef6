NAME limits
OBJSENSE
    MAX
ROWS
 N f
 L a
 G b
 E c
COLUMNS
 x f 1 a 2
 M 'MARKER' 'INTORG'
 y b 1 c 3
 M 'MARKER' 'INTEND'
 z c 4 f -1
RHS
 R a 4 b -2
RANGES
 R a 3.5 c -1
BOUNDS
 UP B x -4
 LI B y 2
 UI B y 7
 MI B z
 UP B z 1e30
QSECTION f
 x x -2
 y x 1
ENDATA
