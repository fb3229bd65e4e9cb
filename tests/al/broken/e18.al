; the shelf was measured with a ruler
        TRANS   ROD [22 33 3.5 90 90 0]
        TRANS   SHELF [60 90 12 90 90 0]
        OPEN    1
        MOVE    ROD
        CLOSE   .2
        SKIPN   2
        WAIT    "no rod"
        CHANGE  Z 1.5
        MOVE    SHELF
        OPEN    1
        PARK
