NAME          A FIXED ONE
ROWS
 N  TOTAL CO
 L  ROW 1
 G  R
COLUMNS
    X ONE     TOTAL CO           1.0   ROW 1              2.5
    X ONE     R                 -1.0
    Y         ROW 1              4.0   R                  1.0
RHS
    RIGHT ON  ROW 1             10.0   R                  2.0
RANGES
    RANGE     ROW 1              3.0
BOUNDS
 UP BND SET   X ONE              4.0
 FR BND SET   Y
QUADOBJ
    X ONE     Y                  0.5
ENDATA
