        TRANS   NUT [18 40 2.5 90 90 0]
        TRANS   TRAY [28 34 3 90 90 0]
        OPEN    1.2
        MOVE    NUT
        CLOSE   .4 .6
        SKIPE   2
        SKIPE   7
        JUMP    GOT
        WAIT    "NO NUT, OR NOT THE RIGHT ONE"
GOT:    CHANGE  [0 0 1] 2
        MOVE    TRAY
        OPEN    1.2
        PARK
