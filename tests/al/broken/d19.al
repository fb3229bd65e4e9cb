        TRANS   NUT [18 40 2.5 90 90 0]
        TRANS   TRAY [28 34 3 90 90 0]
        OPEN    1.2
        MOVE    NUT
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] 1.5
        SAVE    FOUND
        CHANGE  [0 0 1] 2
        WHERE
        MOVE    FOUND
        CLOSE   .4
        CHANGE  [0 0 1] 2
        MOVE    TRAY
        OPEN    1.2
        PARK
