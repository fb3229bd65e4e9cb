        VECT    DOWN [0 0 -1]
        TRANS   NUT [18 40 2.5 90 90 0]
        TRANS   TRAY [28 34 3 90 90 0]
        OPEN    1.2
        MOVE    NUT
        CLOSE   .4
        CHANGE  DOWN -2
        MOVE    TRAY
        STOP    DOWN
        CHANGE  DOWN 1
        OPEN    1.2
        CHANGE  Z 2
        PARK
