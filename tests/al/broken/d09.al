        TRANS   SHELF [26 36 5 1.5708 1.5708 0]
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 2
        MOVE    SHELF
        WHERE
        MOVE    P1UP
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.2
        OPEN    1
        PARK
